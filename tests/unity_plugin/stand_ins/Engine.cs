using System;
using System.Collections.Generic;
using System.Reflection;
using UnityEngine.Rendering;

namespace UnityEngine.Rendering
{
    public enum IndexFormat { UInt16, UInt32 }
}

namespace UnityEngine
{
    [AttributeUsage(AttributeTargets.All, AllowMultiple = true)]
    public class StandInAttribute : Attribute {}

    public sealed class AddComponentMenu : StandInAttribute
    {
        public AddComponentMenu(string menuName) {}
    }

    public sealed class DefaultExecutionOrder : StandInAttribute
    {
        public readonly int order;

        public DefaultExecutionOrder(int order)
        {
            this.order = order;
        }
    }

    public sealed class RequireComponent : StandInAttribute
    {
        public RequireComponent(Type requiredComponent) {}
    }

    public sealed class TooltipAttribute : StandInAttribute
    {
        public TooltipAttribute(string tooltip) {}
    }

    public sealed class MinAttribute : StandInAttribute
    {
        public MinAttribute(float min) {}
    }

    public static class Application
    {
        public static string streamingAssetsPath = "";
        public static string temporaryCachePath = "";
        public static string dataPath = "";
    }

    public static class Debug
    {
        public static readonly List<string> Errors = new List<string>();

        public static void LogError(object message, Object context)
        {
            Errors.Add(message.ToString());
        }
    }

    public static class Gizmos
    {
        public static Matrix4x4 matrix { get; set; }

        public static void DrawWireCube(Vector3 center, Vector3 size) {}
    }

    public class Object
    {
        public string name { get; set; } = "";

        public static void Destroy(Object it) {}

        public static T[] FindObjectsOfType<T>() where T : Object
        {
            var found = new List<T>();
            foreach (Component component in Game.Components)
            {
                if (component is T) found.Add((T)(Object)component);
            }
            return found.ToArray();
        }
    }

    public sealed class Material : Object {}

    public class Component : Object
    {
        public GameObject gameObject { get; internal set; }

        public Transform transform => gameObject.transform;

        public T GetComponent<T>() where T : Component
        {
            return gameObject.GetComponent<T>();
        }
    }

    public class Behaviour : Component {}

    public class MonoBehaviour : Behaviour {}

    public sealed class Transform : Component
    {
        public Vector3 position = Vector3.zero;
        public Vector3 localScale = Vector3.one;
        public Vector3 eulerAngles = Vector3.zero;

        public Vector3 lossyScale => localScale;
        public Matrix4x4 localToWorldMatrix =>
            Matrix4x4.TRS(position, Quaternion.Euler(eulerAngles), localScale);
        public Matrix4x4 worldToLocalMatrix => localToWorldMatrix.inverse;

        public Vector3 InverseTransformPoint(Vector3 point)
        {
            return worldToLocalMatrix.MultiplyPoint3x4(point);
        }
    }

    public sealed class MeshFilter : Component
    {
        public Mesh sharedMesh;
    }

    public sealed class MeshRenderer : Component
    {
        public Material sharedMaterial;
    }

    public enum PrimitiveType { Sphere }

    public sealed class GameObject : Object
    {
        private readonly List<Component> components = new List<Component>();
        private bool isActive = true;

        public GameObject(string name)
        {
            this.name = name;
            transform = new Transform { gameObject = this };
        }

        public Transform transform { get; }

        public static GameObject CreatePrimitive(PrimitiveType type)
        {
            return new GameObject(type.ToString());
        }

        public T GetComponent<T>() where T : Component
        {
            return (T)components.Find(c => c is T);
        }

        public T AddComponent<T>() where T : Component, new()
        {
            var component = new T { gameObject = this, name = name };
            components.Add(component);
            Game.Components.Add(component);
            if (isActive) Game.Call(component, "OnEnable");
            return component;
        }

        public void SetActive(bool value)
        {
            if (isActive == value) return;
            isActive = value;
            foreach (Component component in components)
            {
                Game.Call(component, value ? "OnEnable" : "OnDisable");
            }
        }
    }

    // What Unity's loop does.
    public static class Game
    {
        public static readonly List<Component> Components = new List<Component>();

        public static void Call(Component component, string message)
        {
            MethodInfo method = component.GetType().GetMethod(
                message, BindingFlags.Instance | BindingFlags.NonPublic |
                             BindingFlags.Public | BindingFlags.DeclaredOnly);
            if (method != null) method.Invoke(component, null);
        }

        // One frame: scripts in their order.
        public static void Tick()
        {
            var ordered = new List<Component>(Components);
            ordered.Sort((a, b) => Order(a) != Order(b)
                                       ? Order(a).CompareTo(Order(b))
                                       : Components.IndexOf(a).CompareTo(
                                             Components.IndexOf(b)));
            foreach (Component component in ordered) Call(component, "Update");
            foreach (Component component in ordered) Call(component, "LateUpdate");
        }

        public static void Clear()
        {
            foreach (Component component in Components) Call(component, "OnDisable");
            foreach (Component component in Components) Call(component, "OnDestroy");
            Components.Clear();
            Debug.Errors.Clear();
        }

        private static int Order(Component component)
        {
            object[] found = component.GetType().GetCustomAttributes(
                typeof(DefaultExecutionOrder), true);
            return found.Length == 0 ? 0 : ((DefaultExecutionOrder)found[0]).order;
        }
    }

    // Holds what it is given, with the copies that Unity makes.
    public sealed class Mesh : Object
    {
        private Vector3[] points = new Vector3[0];
        private int[] indices = new int[0];
        private Vector2[] texture = new Vector2[0];

        public int NumUpdates { get; private set; }
        public int NumNormals { get; private set; }
        public Bounds bounds { get; private set; }
        public IndexFormat indexFormat { get; set; }
        public int vertexCount => points.Length;

        public Vector3[] vertices => (Vector3[])points.Clone();

        public int[] triangles
        {
            get { return (int[])indices.Clone(); }
            set { indices = (int[])value.Clone(); }
        }

        public Vector2[] uv
        {
            get { return (Vector2[])texture.Clone(); }
            set { texture = (Vector2[])value.Clone(); }
        }

        public void MarkDynamic() {}

        public void SetVertices(Vector3[] inVertices)
        {
            if (points.Length != inVertices.Length) points = new Vector3[inVertices.Length];
            Array.Copy(inVertices, points, points.Length);
            ++NumUpdates;
        }

        public void RecalculateNormals()
        {
            ++NumNormals;
        }

        public void RecalculateBounds()
        {
            var b = new Bounds { min = points[0], max = points[0] };
            foreach (Vector3 p in points)
            {
                b.min = new Vector3(Math.Min(b.min.x, p.x), Math.Min(b.min.y, p.y),
                                    Math.Min(b.min.z, p.z));
                b.max = new Vector3(Math.Max(b.max.x, p.x), Math.Max(b.max.y, p.y),
                                    Math.Max(b.max.z, p.z));
            }
            bounds = b;
        }
    }
}
