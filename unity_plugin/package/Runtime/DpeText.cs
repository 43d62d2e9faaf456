// Text between .NET and the library, and failures as exceptions. Nothing here needs Unity.
using System;
using System.Text;

namespace Dpe
{
    public sealed class DpeException : Exception
    {
        public DpeException(DpeStatus status, string message) : base(message)
        {
            Status = status;
        }

        public DpeStatus Status { get; }
    }

    public static class DpeText
    {
        // (buffer, capacity, out length)
        public delegate DpeStatus Getter(byte[] buffer, int capacity, out int length);

        // UTF-8 with a zero byte at the end; null stays null.
        public static byte[] ToBytes(string text)
        {
            if (text == null) return null;
            var bytes = new byte[Encoding.UTF8.GetByteCount(text) + 1];
            Encoding.UTF8.GetBytes(text, 0, text.Length, bytes, 0);
            return bytes;
        }

        // Asks for the length, then for the text. It may grow between the two.
        public static string Get(Getter getter)
        {
            var buffer = new byte[256];
            while (true)
            {
                int length;
                DpeStatus status = getter(buffer, buffer.Length, out length);
                if (status == DpeStatus.Buffer)
                {
                    buffer = new byte[length + 1];
                    continue;
                }
                Check(status);
                return Encoding.UTF8.GetString(buffer, 0, length);
            }
        }

        // The last message of a handle; of the calling thread for 0.
        public static string LastError(ulong handle)
        {
            return Get((byte[] buffer, int capacity, out int length) =>
                           DpeNative.dpe_last_error(handle, buffer, capacity, out length));
        }

        public static void Check(DpeStatus status)
        {
            if (status == DpeStatus.Ok) return;
            throw new DpeException(status, LastError(0));
        }
    }
}
