using UnityEngine;

namespace Dpe
{
    // A recorded motion of a scene's cloths, for DpeCloth to show.
    [AddComponentMenu("dpe/Playback")]
    [DefaultExecutionOrder(-90)]
    public sealed class DpePlayback : MonoBehaviour
    {
        public DpeScene scene;

        [Tooltip("CSV, TRC, OBJ files, PC2 or NumPy; a relative path begins in " +
                 "StreamingAssets.")]
        public string file = "";

        public bool playOnStart = true;
        public bool loop = true;
        public float rate = 1.0f;

        private int generation = -1;
        private bool appliedLoop;
        private float appliedRate;

        // Null if there is none.
        public DpeNativePlayback Native { get; private set; }

        public void Seek(float seconds)
        {
            if (Native != null) Native.Seek(seconds);
        }

        private void Update()
        {
            if (scene == null || scene.Native == null) return;
            if (generation != scene.Generation) Load();
            if (Native == null) return;
            if (rate != appliedRate) Native.SetRate(appliedRate = rate);
            if (loop != appliedLoop) Native.SetLoop(appliedLoop = loop);
        }

        private void OnDisable()
        {
            Unload();
        }

        private void Load()
        {
            Unload();
            generation = scene.Generation;
            if (string.IsNullOrEmpty(file)) return;
            try
            {
                Native = new DpeNativePlayback(scene.Native, DpeScene.FullPath(file));
                Native.SetRate(appliedRate = rate);
                Native.SetLoop(appliedLoop = loop);
                if (playOnStart) Native.Start();
            }
            catch (DpeException e)
            {
                Debug.LogError("dpe: " + e.Message, this);
                Unload();
                generation = scene.Generation;
            }
        }

        private void Unload()
        {
            if (Native != null) Native.Dispose();
            Native = null;
            generation = -1;
        }
    }
}
