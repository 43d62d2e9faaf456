using System;
using System.Diagnostics;
using System.IO;
using System.Threading;
using Dpe.Editor;
using UnityEditor;
using UnityEngine;

namespace Dpe.Tests
{
    public static class EditorTest
    {
        public static void Run(string folder)
        {
            string path = Path.Combine(folder, "generated.txt");
            MakeOpenScene();
            Generates(path);
            Estimates(path);
            Cancels(path);
            IsReloaded(path);
            SaysWhatIsWrong(path);
        }

        // The scene "side": a lying grid of which one row is fixed.
        private static void MakeOpenScene()
        {
            var holder = new GameObject("a cloth");
            holder.AddComponent<MeshFilter>();
            DpeGrid grid = holder.AddComponent<DpeGrid>();
            grid.columns = grid.rows = 6;
            grid.Rebuild();
            DpeClothSource source = holder.AddComponent<DpeClothSource>();
            source.settings = "nn";
            DpePinBox box = new GameObject("box").AddComponent<DpePinBox>();
            box.transform.position = new Vector3(0, 0, 3.5f);
            box.transform.localScale = new Vector3(8, 1, 0.5f);
            new GameObject("wind").AddComponent<DpeWind>().velocity = new Vector3(3, 0, 1);
            DpeCollider sphere = new GameObject("ball").AddComponent<DpeCollider>();
            sphere.transform.position = new Vector3(1, -20, 0);
            DpeScene scene = new GameObject("scene").AddComponent<DpeScene>();
            scene.numFrames = 20;
        }

        private static void Generates(string path)
        {
            EditorUtility.Answers.Enqueue(path);
            DpeMenu.GenerateSceneFile();
            Check.That(EditorUtility.Dialogs.Count == 0, "generated without complaints");
            using (DpeNativeScene scene = DpeNativeScene.FromFile(path))
            {
                DpeSceneInfo info = scene.Info();
                Check.That(info.NumFrames == 20 && info.NumColliders == 1, "its settings");
                DpeObjectInfo cloth = scene.ObjectInfo(0);
                Check.That(cloth.NumVertices == 36 && cloth.NumFixed == 6, "its cloth");
                double[] wind = scene.GetParameter(0, DpeParameter.Wind);
                Check.That(wind[0] == -3 && wind[2] == 1, "its wind");
                // As the library's own grid: vertex 0 at -x, -z, the pins at +z.
                var positions = new float[3 * 36];
                ulong sequence = 0;
                long frame;
                scene.CopyPositions(0, positions, ref sequence, out frame);
                Check.That(positions[0] == -3.5f && positions[2] == -3.5f, "its corner");
                int[] triangles = scene.Triangles(0);
                Check.That(triangles[0] == 0 && triangles[1] == 6 && triangles[2] == 7,
                           "its first triangle");
            }
            // A mesh whose vertices are split along a seam is one cloth.
            Mesh split = DpeGrid.MakeMesh(2, 2, 1.0f, DpeGridPlane.XZ);
            Vector3[] v = split.vertices;
            split.SetVertices(new[] { v[0], v[1], v[2], v[3], v[0] });
            split.triangles = new[] { 0, 3, 2, 4, 1, 3 };
            int[] welded;
            int count = DpeSceneGenerator
                            .Weld(split, Matrix4x4.TRS(Vector3.zero, Quaternion.identity,
                                                       Vector3.one),
                                  out welded)
                            .Count;
            Check.That(count == 4 && welded[3] == 0, "a seam is closed");
        }

        private static void Pump(Func<bool> isDone, string what)
        {
            Stopwatch clock = Stopwatch.StartNew();
            while (!isDone() && clock.Elapsed.TotalSeconds < 300)
            {
                if (EditorApplication.update != null) EditorApplication.update();
                Thread.Sleep(1);
            }
            Check.That(isDone(), what);
        }

        private static void Estimates(string path)
        {
            UnityEngine.Object.FindObjectsOfType<DpeClothSource>()[0].settings = "nG";
            EditorUtility.Answers.Enqueue(path);
            EditorUtility.Answers.Enqueue("");  // no recording
            DpeMenu.GenerateAndEstimate();
            Check.That(!DpeMenu.CanEstimate(), "one at a time");
            Pump(() => EditorUtility.Dialogs.Count > 0, "an estimation ends");
            Check.That(DpeMenu.CanEstimate(), "another may follow");
            Check.That(!EditorUtility.HasProgressBar, "the progress bar is gone");
            Check.That(EditorApplication.update == null, "nothing polls any more");
            string message = EditorUtility.Dialogs[0];
            Check.That(message.Contains("RMS position error") &&
                           message.Contains("optimized.txt"),
                       "what is said: " + message);
            string folder = Path.Combine(Path.GetDirectoryName(path), "generated_estimated");
            Check.That(Directory.GetFiles(folder, "*optimized.txt").Length == 1,
                       "the optimised scene");
            EditorUtility.Dialogs.Clear();
        }

        private static void Cancels(string path)
        {
            EditorUtility.CancelProgress = true;
            var run = new DpeEstimationRun(LongScene(path), "", "");
            Pump(() => run.State != null, "a cancelled estimation ends");
            EditorUtility.CancelProgress = false;
            Check.That(run.State == DpeEstimationState.Cancelled, "cancelled: " + run.State);
            Check.That(EditorUtility.Progress.Count > 0, "progress was shown");
        }

        // One that takes seconds.
        private static string LongScene(string path)
        {
            DpeGrid grid = UnityEngine.Object.FindObjectsOfType<DpeGrid>()[0];
            grid.columns = grid.rows = 20;
            grid.Rebuild();
            UnityEngine.Object.FindObjectsOfType<DpeClothSource>()[0].settings = "LL";
            UnityEngine.Object.FindObjectsOfType<DpeScene>()[0].numFrames = 100;
            string longer = path.Replace("generated", "longer");
            DpeSceneGenerator.Generate(longer);
            return longer;
        }

        private static void IsReloaded(string path)
        {
            new DpeEstimationRun(LongScene(path), "", "");
            AssemblyReloadEvents.Reload();
            Check.That(EditorApplication.update == null && DpeNative.dpe_live_handles() == 0,
                       "a reload ends it");
        }

        private static void SaysWhatIsWrong(string path)
        {
            Game.Clear();
            EditorUtility.Answers.Enqueue(path);
            DpeMenu.GenerateSceneFile();
            Check.That(EditorUtility.Dialogs.Count == 1 && EditorUtility.Dialogs[0].Length > 0,
                       "a scene without cloth");
        }
    }
}
