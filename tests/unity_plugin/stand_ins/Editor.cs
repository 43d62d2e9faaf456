using System;
using System.Collections.Generic;
using UnityEngine;
using Object = UnityEngine.Object;

namespace UnityEditor
{
    [AttributeUsage(AttributeTargets.Method, AllowMultiple = true)]
    public sealed class MenuItem : Attribute
    {
        public MenuItem(string itemName) {}

        public MenuItem(string itemName, bool isValidateFunction) {}
    }

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class InitializeOnLoadAttribute : Attribute {}

    [AttributeUsage(AttributeTargets.Class)]
    public sealed class CustomEditor : Attribute
    {
        public CustomEditor(Type inspectedType) {}
    }

    public class Editor : Object
    {
        public Object target { get; set; }

        public virtual void OnInspectorGUI() {}

        public bool DrawDefaultInspector()
        {
            return false;
        }
    }

    public static class EditorGUI
    {
        public static bool Changed;

        public static void BeginChangeCheck() {}

        public static bool EndChangeCheck()
        {
            return Changed;
        }
    }

    public static class EditorApplication
    {
        public delegate void CallbackFunction();

        public static CallbackFunction update;

        public static event Action quitting;

        public static void Quit()
        {
            if (quitting != null) quitting();
        }
    }

    public static class AssemblyReloadEvents
    {
        public delegate void AssemblyReloadCallback();

        public static event AssemblyReloadCallback beforeAssemblyReload;

        public static void Reload()
        {
            if (beforeAssemblyReload != null) beforeAssemblyReload();
        }
    }

    public static class AssetDatabase
    {
        public static int NumRefreshed;

        public static void Refresh()
        {
            ++NumRefreshed;
        }
    }

    // Answers are what a test says, questions are kept.
    public static class EditorUtility
    {
        public static readonly Queue<string> Answers = new Queue<string>();
        public static readonly List<string> Dialogs = new List<string>();
        public static readonly List<float> Progress = new List<float>();
        public static bool CancelProgress;
        public static bool HasProgressBar;

        public static string SaveFilePanel(string title, string directory,
                                           string defaultName, string extension)
        {
            return Answers.Dequeue();
        }

        public static string OpenFilePanel(string title, string directory, string extension)
        {
            return Answers.Dequeue();
        }

        public static bool DisplayDialog(string title, string message, string ok)
        {
            Dialogs.Add(message);
            return true;
        }

        public static bool DisplayCancelableProgressBar(string title, string info,
                                                        float progress)
        {
            HasProgressBar = true;
            Progress.Add(progress);
            return CancelProgress;
        }

        public static void ClearProgressBar()
        {
            HasProgressBar = false;
        }
    }
}
