using System.IO;
using UnityEngine;

namespace Dpe.Samples
{
    // Put this on an empty game object and play: it makes a scene file of a grid that hangs
    // from one row, shows it, and gives it wind and a sphere to move around.
    public sealed class HangingCloth : MonoBehaviour
    {
        public Material material;

        private void Start()
        {
            string path = Path.Combine(Application.temporaryCachePath, "hanging_cloth.txt");
            WriteScene(path);

            var sceneObject = new GameObject("dpe scene");
            sceneObject.SetActive(false);  // until its file is set
            DpeScene scene = sceneObject.AddComponent<DpeScene>();
            scene.sceneFile = path;
            sceneObject.SetActive(true);

            var clothObject = new GameObject("dpe cloth");
            clothObject.AddComponent<MeshFilter>();
            clothObject.AddComponent<MeshRenderer>().sharedMaterial = material;
            clothObject.AddComponent<DpeCloth>().scene = scene;

            var windObject = new GameObject("dpe wind");
            DpeWind wind = windObject.AddComponent<DpeWind>();
            wind.scene = scene;
            wind.velocity = new Vector3(2, 0, 0);

            GameObject sphere = GameObject.CreatePrimitive(PrimitiveType.Sphere);
            sphere.transform.position = new Vector3(0, -3, 0);
            sphere.transform.localScale = new Vector3(2, 2, 2);
            sphere.AddComponent<DpeCollider>().scene = scene;
        }

        private static void WriteScene(string path)
        {
            const int columns = 20, rows = 20;
            Mesh mesh = DpeGrid.MakeMesh(columns, rows, 4.0f, DpeGridPlane.XZ);
            var lastRow = new int[columns];
            for (int i = 0; i < columns; ++i) lastRow[i] = columns * (rows - 1) + i;
            using (var builder = new DpeNativeBuilder())
            {
                int cloth = builder.AddMesh(DpeCoordinates.FromUnity(mesh.vertices),
                                            DpeCoordinates.MirrorTriangles(mesh.triangles),
                                            DpeNativeBuilder.DefaultMaterial());
                builder.PinVertices(cloth, lastRow);
                using (DpeNativeScene scene = builder.Build()) scene.Save(path);
            }
        }
    }
}
