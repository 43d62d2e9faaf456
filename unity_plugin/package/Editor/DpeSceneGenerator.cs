using System.Collections.Generic;
using UnityEngine;
using Object = UnityEngine.Object;

namespace Dpe.Editor
{
    // Makes a scene file of the open scene: its cloth sources, pin boxes, colliders, wind, and
    // the time steps of its DpeScene.
    public static class DpeSceneGenerator
    {
        // Throws a DpeException if it is not a scene.
        public static void Generate(string path)
        {
            using (var builder = new DpeNativeBuilder())
            {
                var settings = new List<string>();
                DpePinBox[] boxes = Object.FindObjectsOfType<DpePinBox>();
                DpeClothSource[] sources = Object.FindObjectsOfType<DpeClothSource>();
                // The order in which Unity finds them is not one.
                System.Array.Sort(sources,
                                  (a, b) => string.CompareOrdinal(a.name, b.name));
                foreach (DpeClothSource source in sources)
                {
                    AddCloth(source, boxes, builder);
                    settings.Add(source.settings);
                }
                builder.SetSettings(string.Join(",", settings.ToArray()));
                foreach (DpeCollider collider in Object.FindObjectsOfType<DpeCollider>())
                {
                    builder.AddCollider(collider.Data());
                }
                foreach (DpeWind wind in Object.FindObjectsOfType<DpeWind>())
                {
                    builder.SetWind(DpeCoordinates.FromUnity(new[] { wind.velocity }));
                }
                foreach (DpeScene scene in Object.FindObjectsOfType<DpeScene>())
                {
                    builder.SetTime(scene.frameLength, scene.stepsPerFrame, scene.numFrames);
                    builder.SetMethod(null, scene.integrationMethod);
                }
                builder.SetMethod(System.IO.Path.GetFileNameWithoutExtension(path), null);
                using (DpeNativeScene made = builder.Build()) made.Save(path);
            }
        }

        // The vertices of a mesh in the world, those in the same place as one (Unity splits
        // vertices along seams of the texture), and its triangles over them.
        public static List<Vector3> Weld(Mesh mesh, Matrix4x4 toWorld, out int[] triangles)
        {
            var welded = new List<Vector3>();
            var indices = new Dictionary<Vector3, int>();
            Vector3[] vertices = mesh.vertices;
            var place = new int[vertices.Length];
            for (int i = 0; i < vertices.Length; ++i)
            {
                if (!indices.TryGetValue(vertices[i], out place[i]))
                {
                    place[i] = welded.Count;
                    indices.Add(vertices[i], welded.Count);
                    welded.Add(toWorld.MultiplyPoint3x4(vertices[i]));
                }
            }
            triangles = mesh.triangles;
            for (int t = 0; t < triangles.Length; ++t) triangles[t] = place[triangles[t]];
            return welded;
        }

        private static void AddCloth(DpeClothSource source, DpePinBox[] boxes,
                                     DpeNativeBuilder builder)
        {
            Mesh mesh = source.GetComponent<MeshFilter>().sharedMesh;
            if (mesh == null)
            {
                throw new DpeException(DpeStatus.Input, source.name + " has no mesh");
            }
            int[] triangles;
            List<Vector3> vertices =
                Weld(mesh, source.transform.localToWorldMatrix, out triangles);
            int cloth = builder.AddMesh(DpeCoordinates.FromUnity(vertices.ToArray()),
                                        DpeCoordinates.MirrorTriangles(triangles),
                                        source.Material());
            var pins = new List<int>();
            for (int i = 0; i < vertices.Count; ++i)
            {
                foreach (DpePinBox box in boxes)
                {
                    if (!box.Contains(vertices[i])) continue;
                    pins.Add(i);
                    break;
                }
            }
            builder.PinVertices(cloth, pins.ToArray());
        }
    }
}
