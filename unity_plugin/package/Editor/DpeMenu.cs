using System.IO;
using UnityEditor;
using UnityEngine;

namespace Dpe.Editor
{
    public static class DpeMenu
    {
        private const string Root = "Tools/dpe/";
        private static DpeEstimationRun run;

        [MenuItem(Root + "Generate Scene File...")]
        public static void GenerateSceneFile()
        {
            GenerateTo(AskForSceneFile());
        }

        [MenuItem(Root + "Estimate...")]
        public static void Estimate()
        {
            string scene = EditorUtility.OpenFilePanel("Scene file", Folder(), "txt,json");
            if (!string.IsNullOrEmpty(scene)) StartEstimation(scene);
        }

        [MenuItem(Root + "Generate and Estimate...")]
        public static void GenerateAndEstimate()
        {
            string path = AskForSceneFile();
            if (GenerateTo(path)) StartEstimation(path);
        }

        [MenuItem(Root + "Estimate...", true)]
        [MenuItem(Root + "Generate and Estimate...", true)]
        public static bool CanEstimate()
        {
            return run == null;
        }

        private static string Folder()
        {
            return Directory.Exists(Application.streamingAssetsPath)
                       ? Application.streamingAssetsPath
                       : Application.dataPath;
        }

        private static string AskForSceneFile()
        {
            return EditorUtility.SaveFilePanel("Scene file", Folder(), "scene", "txt");
        }

        private static bool GenerateTo(string path)
        {
            if (string.IsNullOrEmpty(path)) return false;
            try
            {
                DpeSceneGenerator.Generate(path);
                AssetDatabase.Refresh();
                return true;
            }
            catch (DpeException e)
            {
                EditorUtility.DisplayDialog("dpe", e.Message, "OK");
                return false;
            }
        }

        private static void StartEstimation(string scene)
        {
            string target = EditorUtility.OpenFilePanel(
                "Recording to fit (cancel: the scene's own motion)", Folder(), "");
            string folder = Path.Combine(Path.GetDirectoryName(scene),
                                         Path.GetFileNameWithoutExtension(scene) +
                                             "_estimated");
            try
            {
                run = new DpeEstimationRun(scene, target ?? "", folder);
                run.Finished += OnFinished;
            }
            catch (DpeException e)
            {
                EditorUtility.DisplayDialog("dpe", e.Message, "OK");
            }
        }

        private static void OnFinished(DpeEstimationRun finished)
        {
            run = null;
            EditorUtility.DisplayDialog("dpe", finished.Message, "OK");
        }
    }
}
