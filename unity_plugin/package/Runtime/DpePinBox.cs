using UnityEngine;

namespace Dpe
{
    // Fixes the vertices of all cloth sources inside of a box: a cube of side 1 that is
    // moved, rotated and scaled as this game object.
    [AddComponentMenu("dpe/Pin Box")]
    public sealed class DpePinBox : MonoBehaviour
    {
        // Boxes are placed by hand.
        private const float Margin = 1e-4f;

        // position: in the world
        public bool Contains(Vector3 position)
        {
            Vector3 local = transform.InverseTransformPoint(position);
            const float half = 0.5f + Margin;
            return Mathf.Abs(local.x) <= half && Mathf.Abs(local.y) <= half &&
                   Mathf.Abs(local.z) <= half;
        }

        private void OnDrawGizmos()
        {
            Gizmos.matrix = transform.localToWorldMatrix;
            Gizmos.DrawWireCube(Vector3.zero, Vector3.one);
        }
    }
}
