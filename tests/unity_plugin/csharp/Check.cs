using System;

namespace Dpe.Tests
{
    // Counts what does not hold.
    public static class Check
    {
        public static int Failures { get; private set; }

        public static void That(bool condition, string what)
        {
            if (condition) return;
            ++Failures;
            Console.Error.WriteLine("failed: " + what);
        }

        public static void Throws(DpeStatus status, Action action, string what)
        {
            try
            {
                action();
                That(false, what + ": nothing was thrown");
            }
            catch (DpeException e)
            {
                That(e.Status == status && e.Message.Length > 0,
                     what + ": " + e.Status + " " + e.Message);
            }
        }

        public static int Report(string name)
        {
            Console.WriteLine(name + ": " + Failures + " failures");
            return Failures == 0 ? 0 : 1;
        }
    }
}
