#include <algorithm>
#include <cstdint>
#include <cstring>

#include "captures/writers.h"

namespace dpe {
namespace {

// Little-endian, whatever the order of this machine.
template <typename Bits>
void AppendBits(Bits bits, std::string* bytes) {
  for (size_t i = 0; i < sizeof(Bits); ++i) {
    bytes->push_back(static_cast<char>(bits >> (8 * i) & 0xff));
  }
}

void AppendFloat(double value, std::string* bytes) {
  const float number = static_cast<float>(value);
  std::uint32_t bits;
  std::memcpy(&bits, &number, sizeof(bits));
  AppendBits(bits, bytes);
}

void AppendDouble(double value, std::string* bytes) {
  std::uint64_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  AppendBits(bits, bytes);
}

void AppendPoints(const PointFrames& points, void (*append)(double, std::string*),
                  std::string* bytes) {
  for (int f = 0; f < points.num_frames; ++f) {
    for (const Eigen::MatrixXd* positions : points.positions) {
      for (long row = 0; row < positions->rows(); ++row) {
        append((*positions)(row, f), bytes);
      }
    }
  }
}

}  // namespace

long PointFrames::num_vertices() const {
  long rows = 0;
  for (const Eigen::MatrixXd* p : positions) rows += p->rows();
  return rows / 3;
}

PointFrames WholeFrames(const Trajectory& trajectory) {
  PointFrames points;
  points.num_frames = trajectory.num_frames();
  for (size_t o = 0; o < trajectory.positions.size(); ++o) {
    const Eigen::MatrixXd& positions = trajectory.positions[o];
    if (positions.size() == 0) continue;
    points.objects.push_back(static_cast<int>(o));
    points.positions.push_back(&positions);
    int whole = 0;
    while (whole < positions.cols() && positions.col(whole).allFinite()) ++whole;
    points.num_frames = std::min(points.num_frames, whole);
  }
  return points;
}

std::string PointsToPc2(const PointFrames& points) {
  std::string bytes("POINTCACHE2\0", 12);
  AppendBits<std::uint32_t>(1, &bytes);
  AppendBits(static_cast<std::uint32_t>(points.num_vertices()), &bytes);
  AppendFloat(0.0, &bytes);  // start frame
  AppendFloat(1.0, &bytes);  // frames from one sample to the next
  AppendBits(static_cast<std::uint32_t>(points.num_frames), &bytes);
  AppendPoints(points, &AppendFloat, &bytes);
  return bytes;
}

std::string PointsToNpy(const PointFrames& points) {
  std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (" +
                       std::to_string(points.num_frames) + ", " +
                       std::to_string(points.num_vertices()) + ", 3), }";
  // The numbers begin at a multiple of 64 bytes, as the format asks for.
  constexpr size_t kBefore = 10;
  while ((kBefore + header.size() + 1) % 64 != 0) header += ' ';
  header += '\n';
  std::string bytes("\x93NUMPY\x01\x00", 8);
  AppendBits(static_cast<std::uint16_t>(header.size()), &bytes);
  bytes += header;
  AppendPoints(points, &AppendDouble, &bytes);
  return bytes;
}

}  // namespace dpe
