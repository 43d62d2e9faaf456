using System;
using System.Collections;

namespace NUnit.Framework
{
    [AttributeUsage(AttributeTargets.Method)]
    public sealed class TestAttribute : Attribute {}

    public sealed class AssertionException : Exception
    {
        public AssertionException(string message) : base(message) {}
    }

    public static class Assert
    {
        public static void AreEqual(object expected, object actual)
        {
            if (Equals(expected, actual)) return;
            throw new AssertionException("expected " + expected + ", got " + actual);
        }

        public static void Less(float value, float limit)
        {
            if (value < limit) return;
            throw new AssertionException(value + " is not less than " + limit);
        }
    }

    public static class CollectionAssert
    {
        public static void AreEqual(IEnumerable expected, IEnumerable actual)
        {
            IEnumerator e = expected.GetEnumerator(), a = actual.GetEnumerator();
            while (true)
            {
                bool hasMore = e.MoveNext();
                Assert.AreEqual(hasMore, a.MoveNext());
                if (!hasMore) return;
                Assert.AreEqual(e.Current, a.Current);
            }
        }
    }
}
