// The one place where Unity's coordinates and the library's meet.
//
// Unity's world is left-handed, the library's right-handed; both have y up and metres. They
// are each other's mirror image in the plane x = 0, as in Unity's own import of OBJ files:
//
//   position, velocity, wind   (x, y, z)  ->  (-x, y, z)
//   triangle                   (a, b, c)  ->  (a, c, b), so that its front stays its front
//   rotation R                 M R M, M = diag(-1, 1, 1); of Euler angles in Unity's order,
//                              R_y R_x R_z: (ex, ey, ez) -> (ex, -ey, -ez)
//
// Each is its own inverse.
using System;
using UnityEngine;

namespace Dpe
{
    public static class DpeCoordinates
    {
        public static Vector3 Mirror(Vector3 v)
        {
            return new Vector3(-v.x, v.y, v.z);
        }

        public static Vector3 MirrorEuler(Vector3 degrees)
        {
            return new Vector3(degrees.x, -degrees.y, -degrees.z);
        }

        // The library's positions to Unity's; as many as `to` has.
        public static void ToUnity(float[] from, Vector3[] to)
        {
            for (int i = 0; i < to.Length; ++i)
            {
                to[i] = new Vector3(-from[3 * i], from[3 * i + 1], from[3 * i + 2]);
            }
        }

        public static double[] FromUnity(Vector3[] from)
        {
            var to = new double[3 * from.Length];
            for (int i = 0; i < from.Length; ++i) FromUnity(from[i], to, 3 * i);
            return to;
        }

        public static void FromUnity(Vector3 from, double[] to, int offset)
        {
            to[offset] = -(double)from.x;
            to[offset + 1] = from.y;
            to[offset + 2] = from.z;
        }

        // Either way.
        public static int[] MirrorTriangles(int[] triangles)
        {
            var mirrored = (int[])triangles.Clone();
            for (int t = 0; t + 2 < mirrored.Length; t += 3)
            {
                Array.Reverse(mirrored, t + 1, 2);
            }
            return mirrored;
        }
    }
}
