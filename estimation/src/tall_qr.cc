#include "tall_qr.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>

#include "dpe/engine/parallel.h"

extern "C" {
// QR of a triangle above a rectangle whose last l rows are a trapezium; compact WY
// form. LAPACK has no header of its own that every distribution installs.
void dtpqrt_(const int* m, const int* n, const int* l, const int* nb, double* a,
             const int* lda, double* b, const int* ldb, double* t, const int* ldt,
             double* work, int* info);
}

namespace dpe {
namespace {

// Each stream costs an R and, at its end, 2/3 n^3 operations.
constexpr int kMaxStreams = 8;
constexpr int kColumnsPerPanel = 32;

// R := the triangle of [R; rows], of whose rows the last `trapezium` are upper
// triangular. Overwrites `rows`.
class Folder {
 public:
  explicit Folder(int n)
      : n_(n),
        panel_(std::min(kColumnsPerPanel, n)),
        t_(panel_ * n),
        work_(panel_ * n) {}

  void Fold(Eigen::Ref<Eigen::MatrixXd> rows, int trapezium, Eigen::MatrixXd* r) {
    const int m = static_cast<int>(rows.rows());
    const int stride = static_cast<int>(rows.outerStride());
    int info = 0;
    dtpqrt_(&m, &n_, &trapezium, &panel_, r->data(), &n_, rows.data(), &stride,
            t_.data(), &panel_, work_.data(), &info);
  }

 private:
  int n_;
  int panel_;
  Eigen::VectorXd t_, work_;
};

int NumStreams(const std::vector<int>& chunk_rows, int num_columns) {
  const double num_rows = std::accumulate(chunk_rows.begin(), chunk_rows.end(), 0.0);
  // At a quarter of A's memory the Rs still cost little beside it.
  const int affordable = static_cast<int>(num_rows / (4.0 * num_columns));
  const int num_chunks = static_cast<int>(chunk_rows.size());
  return std::max(1, std::min({affordable, num_chunks, kMaxStreams}));
}

}  // namespace

std::vector<int> ChunkRows(int num_rows) {
  std::vector<int> chunk_rows;
  for (int row = 0; row < num_rows; row += kRowsPerChunk) {
    chunk_rows.push_back(std::min(kRowsPerChunk, num_rows - row));
  }
  return chunk_rows;
}

bool TallQr(const std::vector<int>& chunk_rows, int num_columns, int num_threads,
            const std::function<bool(int, Eigen::Ref<Eigen::MatrixXd>)>& fill,
            Eigen::MatrixXd* r) {
  const int num_chunks = static_cast<int>(chunk_rows.size());
  const int num_streams = NumStreams(chunk_rows, num_columns);
  std::vector<Eigen::MatrixXd> triangles(num_streams);
  std::mutex fill_mutex;
  std::atomic<bool> ok{true};
  ParallelFor(num_threads, num_streams, [&](int s) {
    triangles[s].setZero(num_columns, num_columns);
    Folder folder(num_columns);
    Eigen::MatrixXd memory;
    for (int chunk = s; chunk < num_chunks && ok; chunk += num_streams) {
      if (memory.rows() < chunk_rows[chunk]) {
        memory.resize(chunk_rows[chunk], num_columns);
      }
      const auto rows = memory.topRows(chunk_rows[chunk]);
      {
        const std::lock_guard<std::mutex> lock(fill_mutex);
        if (!ok || !fill(chunk, rows)) ok = false;
      }
      if (ok) folder.Fold(rows, 0, &triangles[s]);
    }
  });
  for (int stride = 1; stride < num_streams && ok; stride *= 2) {
    const int num_pairs = (num_streams - stride + 2 * stride - 1) / (2 * stride);
    ParallelFor(num_threads, num_pairs, [&](int pair) {
      const int first = 2 * stride * pair;
      Folder(num_columns)
          .Fold(triangles[first + stride], num_columns, &triangles[first]);
      triangles[first + stride].resize(0, 0);
    });
  }
  *r = std::move(triangles[0]);
  return ok;
}

}  // namespace dpe
