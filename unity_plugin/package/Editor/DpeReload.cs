using UnityEditor;

namespace Dpe.Editor
{
    // Ends all threads of the library before the editor reloads its scripts.
    [InitializeOnLoad]
    public static class DpeReload
    {
        static DpeReload()
        {
            AssemblyReloadEvents.beforeAssemblyReload += () => DpeNative.dpe_shutdown();
            EditorApplication.quitting += () => DpeNative.dpe_shutdown();
        }
    }
}
