using System;
using System.IO;
using System.Text;
using System.Text.RegularExpressions;

namespace Dpe.Tests
{
    // Frames x vertices x 3 as simulate_cloth writes them to a .npy file.
    public sealed class Motion
    {
        public readonly int NumFrames, NumCoordinates;
        private readonly double[] positions;

        public Motion(string path)
        {
            byte[] bytes = File.ReadAllBytes(path);
            int size = BitConverter.ToUInt16(bytes, 8);
            string header = Encoding.ASCII.GetString(bytes, 10, size);
            Match shape = Regex.Match(header, @"'shape': \((\d+), (\d+), 3");
            if (!shape.Success || !header.Contains("<f8"))
            {
                throw new InvalidDataException(path + ": " + header);
            }
            NumFrames = int.Parse(shape.Groups[1].Value);
            NumCoordinates = 3 * int.Parse(shape.Groups[2].Value);
            positions = new double[NumFrames * NumCoordinates];
            Buffer.BlockCopy(bytes, 10 + size, positions, 0, 8 * positions.Length);
        }

        // How many coordinates of a frame differ, as floats.
        public int Differences(long frame, float[] from)
        {
            int differences = 0;
            for (int i = 0; i < NumCoordinates; ++i)
            {
                if ((float)positions[frame * NumCoordinates + i] != from[i]) ++differences;
            }
            return differences;
        }
    }
}
