using UnityEngine;

namespace Dpe
{
    public enum DpeGridPlane { XZ, YZ }

    // Makes the mesh of a rectangular cloth: columns x rows vertices, vertex columns * j + i,
    // as the library's own grids.
    [AddComponentMenu("dpe/Grid")]
    [RequireComponent(typeof(MeshFilter))]
    public sealed class DpeGrid : MonoBehaviour
    {
        [Min(2)]
        public int columns = 12;
        [Min(2)]
        public int rows = 12;
        [Min(0.001f)]
        public float size = 7.0f;
        [Tooltip("XZ lies, YZ stands.")]
        public DpeGridPlane plane = DpeGridPlane.XZ;

        public static Mesh MakeMesh(int columns, int rows, float size, DpeGridPlane plane)
        {
            var vertices = new Vector3[columns * rows];
            var coordinates = new Vector2[columns * rows];
            for (int j = 0; j < rows; ++j)
            {
                for (int i = 0; i < columns; ++i)
                {
                    float u = (float)i / (columns - 1), v = (float)j / (rows - 1);
                    float a = size * (u - 0.5f), b = size * (v - 0.5f);
                    // In the library's coordinates a grid begins at -x.
                    vertices[columns * j + i] = DpeCoordinates.Mirror(
                        plane == DpeGridPlane.XZ ? new Vector3(a, 0.0f, b)
                                                 : new Vector3(0.0f, a, b));
                    coordinates[columns * j + i] = new Vector2(u, v);
                }
            }
            var mesh = new Mesh { name = "dpe grid" };
            mesh.SetVertices(vertices);
            mesh.uv = coordinates;
            mesh.triangles = DpeCoordinates.MirrorTriangles(Triangles(columns, rows));
            mesh.RecalculateNormals();
            mesh.RecalculateBounds();
            return mesh;
        }

        // Makes the mesh anew.
        public void Rebuild()
        {
            GetComponent<MeshFilter>().sharedMesh = MakeMesh(columns, rows, size, plane);
        }

        private void Reset()
        {
            Rebuild();
        }

        private static int[] Triangles(int columns, int rows)
        {
            var triangles = new int[6 * (columns - 1) * (rows - 1)];
            int next = 0;
            for (int i = 0; i + 1 < columns; ++i)
            {
                for (int j = 0; j + 1 < rows; ++j)
                {
                    int a = columns * j + i, b = a + columns, c = b + 1, d = a + 1;
                    foreach (int vertex in new[] { a, b, c, a, c, d })
                    {
                        triangles[next++] = vertex;
                    }
                }
            }
            return triangles;
        }
    }
}
