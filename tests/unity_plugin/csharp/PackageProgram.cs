// The package's components, its menu and its own tests, against stand-ins of Unity and with
// the real library.
//
//   PackageProgram.exe SCENE MOTION [...]
using System;
using System.IO;
using System.Reflection;
using System.Threading;
using Dpe.Editor;
using NUnit.Framework;
using UnityEditor;
using UnityEngine;

namespace Dpe.Tests
{
    public static class PackageProgram
    {
        public static int Main(string[] arguments)
        {
            string folder = Path.Combine(Path.GetTempPath(), "package");
            Directory.CreateDirectory(folder);
            Application.streamingAssetsPath = Path.GetDirectoryName(arguments[0]);
            Application.dataPath = Application.temporaryCachePath = folder;
            PackageTests();
            ComponentsTest.Run(arguments[0], arguments[1], new Motion(arguments[1]));
            EditorTest.Run(folder);
            Check.That(DpeNative.dpe_live_handles() == 0, "no handle is left");
            return Check.Report("package");
        }

        private static void PackageTests()
        {
            int run = 0;
            foreach (MethodInfo method in typeof(DpeCoordinatesTests).GetMethods())
            {
                if (method.GetCustomAttributes(typeof(TestAttribute), true).Length == 0)
                {
                    continue;
                }
                ++run;
                try
                {
                    method.Invoke(new DpeCoordinatesTests(), null);
                }
                catch (TargetInvocationException e)
                {
                    Check.That(false, method.Name + ": " + e.InnerException.Message);
                }
            }
            Check.That(run == 5, "the package's tests, of which " + run + " ran");
        }
    }
}
