// A recorded motion of the library. Nothing here needs Unity.
using System;

namespace Dpe
{
    public sealed class DpeNativePlayback : IDisposable
    {
        private ulong handle;

        public DpeNativePlayback(DpeNativeScene scene, string path)
        {
            DpeText.Check(DpeNative.dpe_playback_create(DpeNative.HeaderVersion, scene.Handle,
                                                        DpeText.ToBytes(path), out handle));
        }

        ~DpeNativePlayback()
        {
            Destroy();
        }

        public void Dispose()
        {
            Destroy();
            GC.SuppressFinalize(this);
        }

        public DpePlaybackInfo Info()
        {
            DpePlaybackInfo info;
            DpeText.Check(DpeNative.dpe_playback_get_info(handle, out info));
            return info;
        }

        public void Start()
        {
            DpeText.Check(DpeNative.dpe_playback_start(handle));
        }

        public void Pause()
        {
            DpeText.Check(DpeNative.dpe_playback_pause(handle));
        }

        public void Stop()
        {
            DpeText.Check(DpeNative.dpe_playback_stop(handle));
        }

        public void Seek(double time)
        {
            DpeText.Check(DpeNative.dpe_playback_seek(handle, time));
        }

        public void SetRate(double rate)
        {
            DpeText.Check(DpeNative.dpe_playback_set_rate(handle, rate));
        }

        public void SetLoop(bool loop)
        {
            DpeText.Check(DpeNative.dpe_playback_set_loop(handle, loop ? 1 : 0));
        }

        public bool CopyPositions(int objectIndex, float[] positions, ref ulong sequence,
                                  out long frame)
        {
            int isNew;
            DpeText.Check(DpeNative.dpe_playback_copy_positions(
                handle, objectIndex, positions, positions.Length, ref sequence, out frame,
                out isNew));
            return isNew != 0;
        }

        private void Destroy()
        {
            if (handle != 0) DpeNative.dpe_playback_destroy(handle);
            handle = 0;
        }
    }
}
