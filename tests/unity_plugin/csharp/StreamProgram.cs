// The library through the package's own imports, under Mono.
//
//   StreamProgram.exe SCENE MOTION [SCENE MOTION ...]
//
// Exits with 0 if the positions are those that simulate_cloth wrote, frame by frame, and
// playback, estimation and destroying behave.
using System;
using System.Diagnostics;
using System.IO;
using System.Threading;

namespace Dpe.Tests
{
    public static class StreamProgram
    {
        public static int Main(string[] arguments)
        {
            Check.That(DpeNative.dpe_check_version(DpeNative.HeaderVersion) == DpeStatus.Ok,
                       "the version");
            for (int i = 0; i + 1 < arguments.Length; i += 2)
            {
                string scene = arguments[i];
                var motion = new Motion(arguments[i + 1]);
                Stepped(scene, motion);
                Threaded(scene, motion);
                Playback(scene, arguments[i + 1], motion);
            }
            Reload(arguments[0]);
            Errors(arguments[0]);
            EstimationTest.Run(arguments[0]);
            Check.That(DpeNative.dpe_live_handles() == 0, "no handle is left");
            return Check.Report("stream");
        }

        private static void Stepped(string path, Motion motion)
        {
            using (DpeNativeScene scene = DpeNativeScene.FromFile(path))
            {
                var positions = new float[motion.NumCoordinates];
                ulong sequence = 0;
                for (int f = 0; f < motion.NumFrames; ++f)
                {
                    if (f > 0) scene.Step(1);
                    long frame;
                    bool isNew = scene.CopyPositions(0, positions, ref sequence, out frame);
                    Check.That(isNew && frame == f, path + ": frame " + f);
                    Check.That(motion.Differences(f, positions) == 0,
                               path + ": stepped to frame " + f);
                    Check.That(!scene.CopyPositions(0, positions, ref sequence, out frame),
                               path + ": the same is not new");
                }
            }
        }

        // At the rate of the clock, as a game would: whatever frames it sees.
        private static void Threaded(string path, Motion motion)
        {
            using (DpeNativeScene scene = DpeNativeScene.FromFile(path))
            {
                var positions = new float[motion.NumCoordinates];
                ulong sequence = 0;
                long frame = 0, last = -1;
                int seen = 0;
                double length = scene.Info().FrameLength;
                Stopwatch clock = Stopwatch.StartNew();
                scene.Start();
                while (last < motion.NumFrames - 1)
                {
                    if (!scene.CopyPositions(0, positions, ref sequence, out frame))
                    {
                        Thread.Sleep(1);
                        continue;
                    }
                    Check.That(frame > last || last < 0, path + ": frames go forward");
                    last = frame;
                    if (frame >= motion.NumFrames) break;
                    ++seen;
                    Check.That(motion.Differences(frame, positions) == 0,
                               path + ": running, frame " + frame);
                }
                double seconds = clock.Elapsed.TotalSeconds;
                Check.That(seconds > 0.99 * length * (motion.NumFrames - 1),
                           path + ": not ahead of the clock");
                Check.That(seen > motion.NumFrames / 4,
                           path + ": saw " + seen + " of " + motion.NumFrames + " frames");
                scene.Pause();
                Check.That(scene.Info().State == (int)DpeState.Paused, "paused");
                scene.Stop();
                scene.CopyPositions(0, positions, ref sequence, out frame);
                Check.That(frame == 0 && motion.Differences(0, positions) == 0, "stopped");
            }
        }

        private static void Playback(string path, string recording, Motion motion)
        {
            using (DpeNativeScene scene = DpeNativeScene.FromFile(path))
            using (var playback = new DpeNativePlayback(scene, recording))
            {
                var positions = new float[motion.NumCoordinates];
                ulong sequence = 0;
                DpePlaybackInfo info = playback.Info();
                Check.That(info.NumFrames == motion.NumFrames, path + ": all frames");
                for (int f = motion.NumFrames - 1; f >= 0; --f)
                {
                    long frame;
                    playback.Seek(f * info.FrameLength);
                    playback.CopyPositions(0, positions, ref sequence, out frame);
                    Check.That(frame == f && motion.Differences(f, positions) == 0,
                               path + ": recorded frame " + f);
                }
                playback.SetRate(1e3);
                playback.SetLoop(true);
                playback.Start();
                Thread.Sleep(5);
                Check.That(playback.Info().State == (int)DpeState.Running, "it loops");
                playback.SetLoop(false);
                Thread.Sleep(20);
                Check.That(playback.Info().State == (int)DpeState.Paused, "it ends");
            }
        }

        private static void Reload(string path)
        {
            for (int i = 0; i < 100; ++i)
            {
                DpeNativeScene scene = DpeNativeScene.FromFile(path);
                if (i % 2 == 0) scene.Start();
                if (i % 3 == 0) Thread.Sleep(1);
                scene.Dispose();
                scene.Dispose();
            }
            Check.That(DpeNative.dpe_live_handles() == 0, "reloading leaves nothing");
        }

        private static void Errors(string path)
        {
            Check.Throws(DpeStatus.Input, () => DpeNativeScene.FromFile("nirgendwo/tücher"),
                         "a file that is not there");
            Check.That(DpeText.LastError(0).Contains("tücher"), "UTF-8: " +
                       DpeText.LastError(0));
            DpeNativeScene scene = DpeNativeScene.FromFile(path);
            Check.Throws(DpeStatus.Argument, () => scene.ObjectInfo(7), "no such object");
            Check.Throws(DpeStatus.Input,
                         () => scene.SetParameter(0, DpeParameter.Stiffness,
                                                  new[] { -1.0 }),
                         "a negative stiffness");
            scene.SetParameter(0, DpeParameter.Wind, new[] { 1.0, 2.0, 3.0 });
            Check.That(scene.GetParameter(0, DpeParameter.Wind)[2] == 3.0, "the wind");
            DpeColliderData sphere = default(DpeColliderData);
            sphere.Type = (int)DpeColliderType.Sphere;
            sphere.Radius = 1.0;
            sphere.Stiffness = 100.0;
            int id = scene.AddCollider(sphere);
            Check.That(scene.Info().NumColliders == 1, "a collider");
            scene.RemoveCollider(id);
            scene.Dispose();
            Check.Throws(DpeStatus.Handle, () => scene.Start(), "a disposed scene");
        }
    }
}
