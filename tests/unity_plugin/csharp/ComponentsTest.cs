using System;
using System.Threading;
using UnityEngine;

namespace Dpe.Tests
{
    public static class ComponentsTest
    {
        public static void Run(string file, string recording, Motion motion)
        {
            ShowsTheSimulation(file, motion);
            MakesNoGarbage(file);
            ShowsARecording(file, recording, motion);
            TakesWindAndColliders(file);
            SaysWhatIsWrong();
            PlaysTheSample();
        }

        // Inactive until it has its file.
        private static DpeScene NewScene(string file, bool play)
        {
            var holder = new GameObject("scene");
            holder.SetActive(false);
            DpeScene scene = holder.AddComponent<DpeScene>();
            scene.sceneFile = file;
            scene.playOnStart = play;
            holder.SetActive(true);
            return scene;
        }

        private static DpeCloth NewCloth(DpeScene scene)
        {
            var holder = new GameObject("cloth");
            holder.AddComponent<MeshFilter>();
            DpeCloth cloth = holder.AddComponent<DpeCloth>();
            cloth.scene = scene;
            return cloth;
        }

        // How many vertices of the mesh are not the mirror image of a frame.
        private static int Differences(Motion motion, long frame, Vector3[] vertices)
        {
            var numbers = new float[3 * vertices.Length];
            for (int i = 0; i < vertices.Length; ++i)
            {
                numbers[3 * i] = -vertices[i].x;
                numbers[3 * i + 1] = vertices[i].y;
                numbers[3 * i + 2] = vertices[i].z;
            }
            return motion.Differences(frame, numbers);
        }

        private static void ShowsTheSimulation(string file, Motion motion)
        {
            DpeScene scene = NewScene(file, false);
            DpeCloth cloth = NewCloth(scene);
            for (int f = 0; f < 10; ++f)
            {
                if (f > 0) scene.Native.Step(1);
                Game.Tick();
                Mesh mesh = cloth.GetComponent<MeshFilter>().sharedMesh;
                Check.That(cloth.Frame == f && Differences(motion, f, mesh.vertices) == 0,
                           "the mesh at frame " + f);
                Check.That(mesh.NumNormals == f + 1, "normals at frame " + f);
                Check.That(mesh.bounds.max.x > mesh.bounds.min.x, "bounds");
                // Seen from above in both worlds: the front is where the library's is.
                Vector3[] v = mesh.vertices;
                int[] t = mesh.triangles;
                if (f > 0) continue;
                Vector3 unity = Vector3.Cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]]);
                int[] n = scene.Native.Triangles(0);
                Func<int, Vector3> at = i => DpeCoordinates.Mirror(v[i]);
                Vector3 library = Vector3.Cross(at(n[1]) - at(n[0]), at(n[2]) - at(n[0]));
                Check.That((DpeCoordinates.Mirror(unity) - library).magnitude < 1e-5f,
                           "the front");
            }
            // Somewhere else the cloth is where it was.
            cloth.transform.position = new Vector3(1, 2, 3);
            cloth.transform.eulerAngles = new Vector3(10, 20, 30);
            scene.Native.Step(1);
            Game.Tick();
            Vector3 local = cloth.GetComponent<MeshFilter>().sharedMesh.vertices[5];
            Vector3 world = cloth.transform.localToWorldMatrix.MultiplyPoint3x4(local);
            cloth.transform.position = cloth.transform.eulerAngles = Vector3.zero;
            scene.Native.Stop();
            scene.Native.Step(10);
            Game.Tick();
            Vector3 expected = cloth.GetComponent<MeshFilter>().sharedMesh.vertices[5];
            Check.That((world - expected).magnitude < 1e-4f, "a moved game object");
            scene.Reload();
            Game.Tick();
            Check.That(cloth.Frame == 0, "after a reload");
            Game.Clear();
        }

        // The stand-ins' own loop allocates; the component alone must not.
        private static void MakesNoGarbage(string file)
        {
            DpeScene scene = NewScene(file, false);
            DpeCloth cloth = NewCloth(scene);
            Game.Tick();
            var lateUpdate = (Action)Delegate.CreateDelegate(
                typeof(Action), cloth,
                typeof(DpeCloth).GetMethod("LateUpdate",
                                           System.Reflection.BindingFlags.Instance |
                                               System.Reflection.BindingFlags.NonPublic));
            // Mono counts what is allocated by the collections that it takes: one for some
            // 4 MB. An array of 144 vertices for each of these would be 17 MB. A stop makes a
            // new state, which costs less than a frame.
            const int states = 10000;
            scene.Native.Stop();
            lateUpdate();
            Mesh mesh = cloth.GetComponent<MeshFilter>().sharedMesh;
            int updates = mesh.NumUpdates;
            GC.Collect();
            int collections = GC.CollectionCount(0);
            for (int i = 0; i < states; ++i)
            {
                scene.Native.Stop();
                lateUpdate();
            }
            Check.That(mesh.NumUpdates == updates + states, "all states were shown");
            Check.That(GC.CollectionCount(0) == collections,
                       "garbage: " + (GC.CollectionCount(0) - collections) +
                           " collections in " + states + " updates");
            Game.Clear();
        }

        private static void ShowsARecording(string file, string recording, Motion motion)
        {
            DpeScene scene = NewScene(file, false);
            DpeCloth cloth = NewCloth(scene);
            DpePlayback playback = new GameObject("playback").AddComponent<DpePlayback>();
            playback.scene = scene;
            playback.file = recording;
            playback.playOnStart = false;
            cloth.playback = playback;
            Game.Tick();
            playback.Seek((float)(7 * scene.Native.Info().FrameLength));
            Game.Tick();
            Check.That(cloth.Frame == 7 &&
                           Differences(motion, 7, cloth.GetComponent<MeshFilter>()
                                                      .sharedMesh.vertices) == 0,
                       "a recording");
            playback.rate = 5.0f;
            playback.loop = false;
            Game.Tick();
            Check.That(playback.Native.Info().Rate == 5.0 && playback.Native.Info().Loop == 0,
                       "its settings");
            Game.Clear();
        }

        private static void TakesWindAndColliders(string file)
        {
            DpeScene scene = NewScene(file, true);
            DpeWind wind = new GameObject("wind").AddComponent<DpeWind>();
            wind.scene = scene;
            wind.velocity = new Vector3(1, 2, 3);
            DpeCollider plane = new GameObject("plane").AddComponent<DpeCollider>();
            plane.scene = scene;
            plane.type = DpeColliderType.Plane;
            plane.transform.position = new Vector3(4, -5, 6);
            plane.transform.eulerAngles = new Vector3(10, 20, 30);
            Game.Tick();
            double[] values = scene.Native.GetParameter(0, DpeParameter.Wind);
            Check.That(values[0] == -1 && values[1] == 2 && values[2] == 3, "the wind");
            DpeColliderData data;
            DpeNative.dpe_scene_get_collider(scene.Native.Handle, 0, out data);
            Check.That(data.PositionX == -4 && data.RotationX == 10 && data.RotationY == -20 &&
                           data.RotationZ == -30,
                       "a plane");
            plane.transform.position = new Vector3(7, 0, 0);
            Game.Tick();
            DpeNative.dpe_scene_get_collider(scene.Native.Handle, 0, out data);
            Check.That(data.PositionX == -7, "a plane that moves");
            plane.gameObject.SetActive(false);
            Check.That(scene.Native.Info().NumColliders == 0, "a plane that is gone");
            Game.Clear();
        }

        private static void SaysWhatIsWrong()
        {
            DpeScene scene = NewScene("not_there.txt", true);
            NewCloth(scene);
            Game.Tick();
            Check.That(scene.Native == null && Debug.Errors.Count == 1 &&
                           Debug.Errors[0].Contains("not_there.txt"),
                       "a file that is not there");
            Game.Clear();
        }

        private static void PlaysTheSample()
        {
            var sample = new GameObject("sample").AddComponent<Samples.HangingCloth>();
            Game.Call(sample, "Start");
            DpeCloth cloth = UnityEngine.Object.FindObjectsOfType<DpeCloth>()[0];
            for (int i = 0; i < 500 && cloth.Frame < 10; ++i)
            {
                Game.Tick();
                Thread.Sleep(2);
            }
            Check.That(cloth.Frame >= 10, "the sample runs on its own");
            Check.That(cloth.GetComponent<MeshFilter>().sharedMesh.bounds.min.y < -0.05f,
                       "its cloth falls");
            Check.That(Debug.Errors.Count == 0, "the sample has no errors");
            Game.Clear();
        }
    }
}
