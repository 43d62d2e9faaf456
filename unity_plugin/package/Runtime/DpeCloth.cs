using UnityEngine;
using UnityEngine.Rendering;

namespace Dpe
{
    // Shows one object of a scene, or of a playback, in the mesh of this game object. The
    // mesh is a copy of its own; after the first frame nothing is allocated.
    [AddComponentMenu("dpe/Cloth")]
    [RequireComponent(typeof(MeshFilter))]
    public sealed class DpeCloth : MonoBehaviour
    {
        public DpeScene scene;

        [Tooltip("Shows this recording instead of the simulation; may be empty.")]
        public DpePlayback playback;

        [Min(0)]
        public int objectIndex;

        private Mesh mesh;
        private float[] positions;
        private Vector3[] vertices;
        private ulong sequence;
        private int generation = -1;
        private bool shownPlayback;

        // The frame that is shown; -1: none yet.
        public long Frame { get; private set; } = -1;

        private void LateUpdate()
        {
            if (scene == null || scene.Native == null) return;
            bool isPlayback = playback != null && playback.Native != null;
            if (generation != scene.Generation || mesh == null) Prepare();
            if (isPlayback != shownPlayback) sequence = 0;
            shownPlayback = isPlayback;
            long frame;
            bool isNew =
                isPlayback
                    ? playback.Native.CopyPositions(objectIndex, positions, ref sequence,
                                                    out frame)
                    : scene.Native.CopyPositions(objectIndex, positions, ref sequence,
                                                 out frame);
            if (!isNew) return;
            Frame = frame;
            Show();
        }

        private void OnDestroy()
        {
            if (mesh != null) Destroy(mesh);
        }

        private void Prepare()
        {
            DpeObjectInfo info = scene.Native.ObjectInfo(objectIndex);
            positions = new float[3 * info.NumVertices];
            vertices = new Vector3[info.NumVertices];
            sequence = 0;
            Frame = -1;
            if (mesh != null) Destroy(mesh);
            mesh = new Mesh { name = "dpe cloth " + objectIndex };
            if (info.NumVertices > 65535) mesh.indexFormat = IndexFormat.UInt32;
            mesh.MarkDynamic();
            mesh.SetVertices(vertices);
            KeepTexture(info.NumVertices);
            mesh.triangles =
                DpeCoordinates.MirrorTriangles(scene.Native.Triangles(objectIndex));
            GetComponent<MeshFilter>().sharedMesh = mesh;
            generation = scene.Generation;
        }

        // Texture coordinates of the mesh that was here, if it is of the same vertices.
        private void KeepTexture(int numVertices)
        {
            Mesh before = GetComponent<MeshFilter>().sharedMesh;
            if (before == null || before.vertexCount != numVertices) return;
            Vector2[] coordinates = before.uv;
            if (coordinates.Length == numVertices) mesh.uv = coordinates;
        }

        private void Show()
        {
            DpeCoordinates.ToUnity(positions, vertices);
            // The library knows the world alone, a mesh its game object.
            Matrix4x4 toLocal = transform.worldToLocalMatrix;
            if (!toLocal.isIdentity)
            {
                for (int i = 0; i < vertices.Length; ++i)
                {
                    vertices[i] = toLocal.MultiplyPoint3x4(vertices[i]);
                }
            }
            mesh.SetVertices(vertices);
            mesh.RecalculateNormals();
            mesh.RecalculateBounds();
        }
    }
}
