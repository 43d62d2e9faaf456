using NUnit.Framework;
using UnityEngine;

namespace Dpe.Tests
{
    public sealed class DpeCoordinatesTests
    {
        [Test]
        public void MirroringTwiceIsNothing()
        {
            var v = new Vector3(1, 2, 3);
            Assert.AreEqual(v, DpeCoordinates.Mirror(DpeCoordinates.Mirror(v)));
            Assert.AreEqual(v, DpeCoordinates.MirrorEuler(DpeCoordinates.MirrorEuler(v)));
            var triangles = new[] { 0, 1, 2, 2, 1, 3 };
            CollectionAssert.AreEqual(new[] { 0, 2, 1, 2, 3, 1 },
                                      DpeCoordinates.MirrorTriangles(triangles));
        }

        // The normal of a plane that Unity rotates is that of the rotated mirror image.
        [Test]
        public void RotationsAreMirrored()
        {
            foreach (var degrees in new[] { new Vector3(30, 0, 0), new Vector3(0, 50, 0),
                                            new Vector3(0, 0, 70), new Vector3(20, 130, -40) })
            {
                Vector3 expected =
                    DpeCoordinates.Mirror(Quaternion.Euler(degrees) * Vector3.up);
                Vector3 actual =
                    Quaternion.Euler(DpeCoordinates.MirrorEuler(degrees)) * Vector3.up;
                Assert.Less((expected - actual).magnitude, 1e-5f);
            }
        }

        // What is in front of a triangle stays in front of it. Unity's triangles face those
        // who see their corners clockwise, in left-handed coordinates; both worlds have
        // the front where the cross product of their edges points.
        [Test]
        public void FrontsStayFronts()
        {
            Vector3 a = new Vector3(0, 0, 0), b = new Vector3(0, 0, 1),
                    c = new Vector3(1, 0, 0);
            Vector3 front = Vector3.Cross(b - a, c - a);
            int[] t = DpeCoordinates.MirrorTriangles(new[] { 0, 1, 2 });
            Vector3[] mirrored = { DpeCoordinates.Mirror(a), DpeCoordinates.Mirror(b),
                                   DpeCoordinates.Mirror(c) };
            Vector3 there = Vector3.Cross(mirrored[t[1]] - mirrored[t[0]],
                                          mirrored[t[2]] - mirrored[t[0]]);
            Assert.AreEqual(DpeCoordinates.Mirror(front), there);
        }

        [Test]
        public void ArraysAreAsVectors()
        {
            var vectors = new[] { new Vector3(1, 2, 3), new Vector3(-4, 5, -6) };
            double[] numbers = DpeCoordinates.FromUnity(vectors);
            CollectionAssert.AreEqual(new[] { -1.0, 2.0, 3.0, 4.0, 5.0, -6.0 }, numbers);
            var floats = new float[numbers.Length];
            for (int i = 0; i < floats.Length; ++i) floats[i] = (float)numbers[i];
            var back = new Vector3[2];
            DpeCoordinates.ToUnity(floats, back);
            CollectionAssert.AreEqual(vectors, back);
        }

        [Test]
        public void LibraryFitsThePackage()
        {
            Assert.AreEqual(DpeStatus.Ok,
                            DpeNative.dpe_check_version(DpeNative.HeaderVersion));
        }
    }
}
