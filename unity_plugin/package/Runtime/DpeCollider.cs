using UnityEngine;

namespace Dpe
{
    // A sphere or a plane that follows this game object. A sphere's diameter is the x of
    // its scale, as that of Unity's own sphere; a plane is below its game object's y.
    [AddComponentMenu("dpe/Collider")]
    public sealed class DpeCollider : MonoBehaviour
    {
        public DpeScene scene;
        public DpeColliderType type = DpeColliderType.Sphere;

        [Min(0.001f)]
        public float stiffness = 1000.0f;

        private DpeColliderData applied;
        private int id;
        private int generation = -1;

        public DpeColliderData Data()
        {
            Vector3 position = DpeCoordinates.Mirror(transform.position);
            Vector3 rotation = DpeCoordinates.MirrorEuler(transform.eulerAngles);
            return new DpeColliderData
            {
                Type = (int)type,
                PositionX = position.x,
                PositionY = position.y,
                PositionZ = position.z,
                RotationX = rotation.x,
                RotationY = rotation.y,
                RotationZ = rotation.z,
                Radius = transform.lossyScale.x / 2.0f,
                Stiffness = stiffness
            };
        }

        private void Update()
        {
            if (scene == null || scene.Native == null) return;
            DpeColliderData data = Data();
            if (generation != scene.Generation)
            {
                generation = scene.Generation;
                id = scene.Native.AddCollider(data);
            }
            else if (!AreEqual(data, applied))
            {
                scene.Native.SetCollider(id, data);
            }
            applied = data;
        }

        private void OnDisable()
        {
            if (scene != null && scene.Native != null && generation == scene.Generation)
            {
                scene.Native.RemoveCollider(id);
            }
            generation = -1;
        }

        // Without the garbage of ValueType.Equals.
        private static bool AreEqual(DpeColliderData a, DpeColliderData b)
        {
            return a.Type == b.Type && a.PositionX == b.PositionX &&
                   a.PositionY == b.PositionY && a.PositionZ == b.PositionZ &&
                   a.RotationX == b.RotationX && a.RotationY == b.RotationY &&
                   a.RotationZ == b.RotationZ && a.Radius == b.Radius &&
                   a.Stiffness == b.Stiffness;
        }
    }
}
