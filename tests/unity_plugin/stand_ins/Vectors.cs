using System;

namespace UnityEngine
{
    public struct Vector2
    {
        public float x, y;

        public Vector2(float x, float y)
        {
            this.x = x;
            this.y = y;
        }
    }

    public struct Vector3 : IEquatable<Vector3>
    {
        public float x, y, z;

        public Vector3(float x, float y, float z)
        {
            this.x = x;
            this.y = y;
            this.z = z;
        }

        public static Vector3 zero => new Vector3(0, 0, 0);
        public static Vector3 one => new Vector3(1, 1, 1);
        public static Vector3 up => new Vector3(0, 1, 0);

        public float magnitude => (float)Math.Sqrt(Dot(this, this));

        public static float Dot(Vector3 a, Vector3 b)
        {
            return a.x * b.x + a.y * b.y + a.z * b.z;
        }

        public static Vector3 Cross(Vector3 a, Vector3 b)
        {
            return new Vector3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z,
                               a.x * b.y - a.y * b.x);
        }

        public static Vector3 operator +(Vector3 a, Vector3 b)
        {
            return new Vector3(a.x + b.x, a.y + b.y, a.z + b.z);
        }

        public static Vector3 operator -(Vector3 a, Vector3 b)
        {
            return new Vector3(a.x - b.x, a.y - b.y, a.z - b.z);
        }

        public static Vector3 operator *(float s, Vector3 a)
        {
            return new Vector3(s * a.x, s * a.y, s * a.z);
        }

        public static bool operator ==(Vector3 a, Vector3 b)
        {
            return (a - b).magnitude < 1e-5f;
        }

        public static bool operator !=(Vector3 a, Vector3 b)
        {
            return !(a == b);
        }

        public bool Equals(Vector3 other)
        {
            return x == other.x && y == other.y && z == other.z;
        }

        public override bool Equals(object other)
        {
            return other is Vector3 && Equals((Vector3)other);
        }

        public override int GetHashCode()
        {
            return x.GetHashCode() ^ (y.GetHashCode() << 2) ^ (z.GetHashCode() >> 2);
        }

        public override string ToString()
        {
            return "(" + x + ", " + y + ", " + z + ")";
        }
    }

    // A unit quaternion.
    public struct Quaternion
    {
        public float x, y, z, w;

        public Quaternion(float x, float y, float z, float w)
        {
            this.x = x;
            this.y = y;
            this.z = z;
            this.w = w;
        }

        public static Quaternion identity => new Quaternion(0, 0, 0, 1);

        // Unity turns about z, then x, then y.
        public static Quaternion Euler(Vector3 degrees)
        {
            return About(0, degrees.y, 0) * About(degrees.x, 0, 0) * About(0, 0, degrees.z);
        }

        public static Quaternion operator *(Quaternion a, Quaternion b)
        {
            return new Quaternion(a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                                  a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
                                  a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x,
                                  a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z);
        }

        public static Vector3 operator *(Quaternion q, Vector3 v)
        {
            var u = new Vector3(q.x, q.y, q.z);
            Vector3 t = 2.0f * Vector3.Cross(u, v);
            return v + q.w * t + Vector3.Cross(u, t);
        }

        public Quaternion Inverse()
        {
            return new Quaternion(-x, -y, -z, w);
        }

        private static Quaternion About(float x, float y, float z)
        {
            double half = (x + y + z) * Math.PI / 360.0;
            float s = (float)Math.Sin(half);
            return new Quaternion(x != 0 ? s : 0, y != 0 ? s : 0, z != 0 ? s : 0,
                                  (float)Math.Cos(half));
        }
    }

    // p -> position + rotation * (scale * p), or its inverse.
    public struct Matrix4x4
    {
        private Vector3 position, scale;
        private Quaternion rotation;
        private bool isInverse;

        public static Matrix4x4 TRS(Vector3 position, Quaternion rotation, Vector3 scale)
        {
            return new Matrix4x4 { position = position, rotation = rotation, scale = scale };
        }

        public Matrix4x4 inverse
        {
            get
            {
                Matrix4x4 m = this;
                m.isInverse = !isInverse;
                return m;
            }
        }

        public bool isIdentity => position.Equals(Vector3.zero) &&
                                  scale.Equals(Vector3.one) && rotation.w == 1.0f;

        public Vector3 MultiplyPoint3x4(Vector3 p)
        {
            if (!isInverse)
            {
                return position +
                       rotation * new Vector3(scale.x * p.x, scale.y * p.y, scale.z * p.z);
            }
            Vector3 q = rotation.Inverse() * (p - position);
            return new Vector3(q.x / scale.x, q.y / scale.y, q.z / scale.z);
        }
    }

    public static class Mathf
    {
        public static float Abs(float value)
        {
            return Math.Abs(value);
        }
    }

    public struct Bounds
    {
        public Vector3 min, max;
    }
}
