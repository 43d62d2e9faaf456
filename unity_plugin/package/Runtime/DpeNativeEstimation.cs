// An estimation of the library, which runs on a thread of its own. Nothing here needs
// Unity.
using System;

namespace Dpe
{
    public sealed class DpeNativeEstimation : IDisposable
    {
        private ulong handle;
        private DpeProgressCallback callback;  // kept alive as long as it may be called

        public DpeNativeEstimation()
        {
            DpeText.Check(
                DpeNative.dpe_estimation_create(DpeNative.HeaderVersion, out handle));
        }

        ~DpeNativeEstimation()
        {
            Destroy();
        }

        // Cancels it if it runs, and waits for its thread.
        public void Dispose()
        {
            Destroy();
            GC.SuppressFinalize(this);
        }

        public void Set(string name, string value)
        {
            DpeText.Check(DpeNative.dpe_estimation_set_text(handle, DpeText.ToBytes(name),
                                                            DpeText.ToBytes(value)));
        }

        public void Set(string name, double value)
        {
            DpeText.Check(
                DpeNative.dpe_estimation_set_number(handle, DpeText.ToBytes(name), value));
        }

        // Called in the estimation's thread. It must not throw.
        public void SetCallback(DpeProgressCallback progress)
        {
            DpeText.Check(
                DpeNative.dpe_estimation_set_callback(handle, progress, IntPtr.Zero));
            callback = progress;
        }

        public void Start()
        {
            DpeText.Check(DpeNative.dpe_estimation_start(handle));
        }

        public void Cancel()
        {
            DpeText.Check(DpeNative.dpe_estimation_cancel(handle));
        }

        public DpeEstimationState Poll(out DpeProgress progress)
        {
            int state;
            DpeText.Check(DpeNative.dpe_estimation_poll(handle, out state, out progress));
            return (DpeEstimationState)state;
        }

        public DpeEstimationState Wait(double seconds)
        {
            int state;
            DpeText.Check(DpeNative.dpe_estimation_wait(handle, seconds, out state));
            return (DpeEstimationState)state;
        }

        // Why there is no result.
        public string LastError => DpeText.LastError(handle);

        public DpeResult Result()
        {
            DpeResult result;
            DpeText.Check(DpeNative.dpe_estimation_get_result(handle, out result));
            return result;
        }

        public string Message()
        {
            return DpeText.Get((byte[] buffer, int capacity, out int length) =>
                                   DpeNative.dpe_estimation_get_message(
                                       handle, buffer, capacity, out length));
        }

        public string[] Files()
        {
            string text = DpeText.Get((byte[] buffer, int capacity, out int length) =>
                                          DpeNative.dpe_estimation_get_files(
                                              handle, buffer, capacity, out length));
            return text.Split(new[] { '\n' }, StringSplitOptions.RemoveEmptyEntries);
        }

        public double[] Values(int block)
        {
            DpeBlock info;
            DpeText.Check(DpeNative.dpe_estimation_get_block(handle, block, out info));
            var values = new double[info.NumValues];
            int count;
            DpeText.Check(DpeNative.dpe_estimation_get_values(handle, block, values,
                                                              values.Length, out count));
            return values;
        }

        public DpeNativeScene CreateScene()
        {
            ulong scene;
            DpeText.Check(DpeNative.dpe_estimation_create_scene(handle, out scene));
            return new DpeNativeScene(scene);
        }

        private void Destroy()
        {
            if (handle != 0) DpeNative.dpe_estimation_destroy(handle);
            handle = 0;
            // From here on nobody calls it.
            GC.KeepAlive(callback);
            callback = null;
        }
    }
}
