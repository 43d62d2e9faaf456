using System;
using System.IO;
using System.Threading;

namespace Dpe.Tests
{
    public static class EstimationTest
    {
        public static void Run(string scene)
        {
            string folder = Path.Combine(Path.GetTempPath(), "out");
            Finds(scene, folder);
            Cancels(scene);
            using (DpeNativeEstimation estimation = New(scene))
            {
                estimation.Start();
                // Disposed while it runs.
            }
        }

        // One that takes iterations: what was seen has noise.
        private static DpeNativeEstimation New(string scene)
        {
            var estimation = new DpeNativeEstimation();
            estimation.Set("scene", scene);
            estimation.Set("settings", "nn");
            estimation.Set("estimate", "damping");
            estimation.Set("init", "scene");
            estimation.Set("noise_sigma", 1e-3);
            estimation.Set("frames", 20);
            return estimation;
        }

        private static void Finds(string scene, string folder)
        {
            int calls = 0;
            double last = 0.0;
            bool grows = true;
            using (DpeNativeEstimation estimation = New(scene))
            {
                estimation.Set("output_dir", folder);
                estimation.SetCallback((IntPtr user, ref DpeProgress progress) =>
                {
                    Interlocked.Increment(ref calls);
                    grows &= progress.Fraction >= last;
                    last = progress.Fraction;
                });
                estimation.Start();
                DpeEstimationState state = estimation.Wait(300.0);
                Check.That(state == DpeEstimationState.Done,
                           "an estimation ends: " + state + " " + estimation.LastError);
                if (state != DpeEstimationState.Done) return;
                DpeProgress polled;
                estimation.Poll(out polled);
                Check.That(polled.Fraction == 1.0, "its progress ends at 1");
                Check.That(calls > 1 && grows, "progress, " + calls + " calls");
                Check.That(estimation.Result().FinalRms < 1.1e-3 * Math.Sqrt(3.0),
                           "the noise is left: " + estimation.Result().FinalRms);
                Check.That(Math.Abs(estimation.Values(0)[0] - 0.1) < 0.01,
                           "the damping: " + estimation.Values(0)[0]);
                Check.That(estimation.Message().Length > 0, "a message");
                using (DpeNativeScene fitted = estimation.CreateScene())
                using (DpeNativeScene loaded = DpeNativeScene.FromFile(estimation.Files()[0]))
                using (DpeNativeScene taken = DpeNativeScene.FromFile(scene))
                {
                    double[] expected = fitted.GetParameter(0, DpeParameter.Damping);
                    Check.That(loaded.GetParameter(0, DpeParameter.Damping)[0] == expected[0],
                               "the optimised scene is written");
                    taken.LoadOptimized(estimation.Files()[0]);
                    Check.That(taken.GetParameter(0, DpeParameter.Damping)[0] == expected[0],
                               "the optimised scene is taken over");
                }
            }
        }

        private static void Cancels(string scene)
        {
            using (DpeNativeEstimation estimation = New(scene))
            {
                estimation.Set("settings", "nL");
                estimation.SetCallback((IntPtr user, ref DpeProgress progress) =>
                {
                    estimation.Cancel();
                });
                estimation.Start();
                Check.That(estimation.Wait(300.0) == DpeEstimationState.Cancelled,
                           "an estimation is cancelled");
                Check.That(estimation.Result().Iterations <= 3, "soon");
                Check.Throws(DpeStatus.State, () => estimation.Start(), "started again");
            }
        }
    }
}
