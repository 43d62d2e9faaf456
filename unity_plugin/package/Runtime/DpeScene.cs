using System;
using System.IO;
using UnityEngine;

namespace Dpe
{
    // A scene file that is simulated on a thread of its own. DpeCloth shows its cloths,
    // DpeWind and DpeCollider change it.
    [AddComponentMenu("dpe/Scene")]
    [DefaultExecutionOrder(-100)]
    public sealed class DpeScene : MonoBehaviour
    {
        [Tooltip("Scene file; a relative path begins in StreamingAssets.")]
        public string sceneFile = "";

        [Tooltip("An optimised scene whose parameters are taken over; may be empty.")]
        public string optimizedFile = "";

        public bool playOnStart = true;

        [Tooltip("1: real time; 0: as fast as possible.")]
        public float rate = 1.0f;

        // Of scene files that are generated of this Unity scene.
        [Min(0.0001f)]
        public float frameLength = 0.02f;
        [Min(1)]
        public int stepsPerFrame = 1;
        [Min(2)]
        public int numFrames = 100;
        public string integrationMethod = "linearly_implicit_euler";

        private float appliedRate;

        // Null while the component is disabled, or if the file could not be loaded.
        public DpeNativeScene Native { get; private set; }

        // Grows with each scene that is loaded: ids of an older one mean nothing.
        public int Generation { get; private set; }

        public static string FullPath(string path)
        {
            return Path.IsPathRooted(path) ? path
                                           : Path.Combine(Application.streamingAssetsPath, path);
        }

        public void Play()
        {
            if (Native != null) Native.Start();
        }

        public void Pause()
        {
            if (Native != null) Native.Pause();
        }

        // Back to the beginning.
        public void Stop()
        {
            if (Native != null) Native.Stop();
        }

        // Loads the file anew.
        public void Reload()
        {
            Unload();
            Load();
        }

        private void OnEnable()
        {
            Load();
        }

        private void OnDisable()
        {
            Unload();
        }

        private void Update()
        {
            if (Native == null || rate == appliedRate) return;
            appliedRate = rate;
            Native.SetRate(Math.Max(0.0, rate));
        }

        private void Load()
        {
            if (string.IsNullOrEmpty(sceneFile)) return;
            try
            {
                Native = DpeNativeScene.FromFile(FullPath(sceneFile));
                ++Generation;
                if (!string.IsNullOrEmpty(optimizedFile))
                {
                    Native.LoadOptimized(FullPath(optimizedFile));
                }
                appliedRate = rate;
                Native.SetRate(Math.Max(0.0, rate));
                if (playOnStart) Native.Start();
            }
            catch (DpeException e)
            {
                Debug.LogError("dpe: " + e.Message, this);
                Unload();
            }
        }

        private void Unload()
        {
            if (Native != null) Native.Dispose();
            Native = null;
        }
    }
}
