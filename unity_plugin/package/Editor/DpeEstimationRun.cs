using System;
using UnityEditor;
using UnityEngine;

namespace Dpe.Editor
{
    // An estimation inside the editor, with a progress bar that cancels it. The editor goes
    // on meanwhile.
    public sealed class DpeEstimationRun : IDisposable
    {
        private readonly DpeNativeEstimation estimation = new DpeNativeEstimation();
        private readonly string title;
        private bool isCancelled;

        // target: empty for the scene's own motion
        public DpeEstimationRun(string sceneFile, string target, string outputFolder)
        {
            title = "dpe: " + System.IO.Path.GetFileName(sceneFile);
            try
            {
                estimation.Set("scene", sceneFile);
                estimation.Set("target", target);
                estimation.Set("output_dir", outputFolder);
                estimation.Start();
            }
            catch (DpeException)
            {
                estimation.Dispose();
                throw;
            }
            EditorApplication.update += Update;
            // The library's thread must be gone before the scripts are.
            AssemblyReloadEvents.beforeAssemblyReload += Dispose;
        }

        // With what it is over; null as long as it runs.
        public DpeEstimationState? State { get; private set; }

        // What is to be told at the end.
        public string Message { get; private set; } = "";

        public event Action<DpeEstimationRun> Finished;

        public void Dispose()
        {
            EditorApplication.update -= Update;
            AssemblyReloadEvents.beforeAssemblyReload -= Dispose;
            EditorUtility.ClearProgressBar();
            estimation.Dispose();
        }

        private void Update()
        {
            DpeProgress progress;
            DpeEstimationState state = estimation.Poll(out progress);
            if (state == DpeEstimationState.Running)
            {
                Show(progress);
                return;
            }
            State = state;
            Message = state == DpeEstimationState.Failed ? estimation.LastError : Describe();
            Dispose();
            if (state == DpeEstimationState.Done) AssetDatabase.Refresh();
            if (Finished != null) Finished(this);
        }

        private void Show(DpeProgress progress)
        {
            string text = progress.NumFrames == 0
                              ? "reading"
                              : "iteration " + progress.Iteration + ", " +
                                    progress.NumFrames + " frames, RMS error " +
                                    progress.Rms.ToString("g3") + " m";
            if (EditorUtility.DisplayCancelableProgressBar(title, text,
                                                           (float)progress.Fraction) &&
                !isCancelled)
            {
                isCancelled = true;
                estimation.Cancel();
            }
        }

        private string Describe()
        {
            try
            {
                return estimation.Message() + "\nRMS position error " +
                       estimation.Result().FinalRms.ToString("g3") + " m\n" +
                       string.Join("\n", estimation.Files());
            }
            catch (DpeException e)
            {
                return e.Message;  // cancelled before there was anything
            }
        }
    }
}
