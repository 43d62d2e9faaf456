using UnityEditor;
using UnityEngine;

namespace Dpe.Editor
{
    // A grid follows its settings as they are edited.
    [CustomEditor(typeof(DpeGrid))]
    public sealed class DpeGridEditor : UnityEditor.Editor
    {
        public override void OnInspectorGUI()
        {
            EditorGUI.BeginChangeCheck();
            DrawDefaultInspector();
            if (EditorGUI.EndChangeCheck()) ((DpeGrid)target).Rebuild();
        }
    }
}
