// Sees the matrices that the engine hands to CHOLMOD: counts them and keeps one. The
// floor of a forward step is then measured on the very matrix of that step, without
// reaching into the engine.
#ifndef DPE_TESTS_BENCHMARKS_FACTORIZATION_WATCH_H_
#define DPE_TESTS_BENCHMARKS_FACTORIZATION_WATCH_H_

#include <vector>

namespace dpe::bench {

// Compressed columns; only entries on and below the diagonal count.
struct SymmetricMatrix {
  std::vector<int> column_starts;
  std::vector<int> row_indices;
  std::vector<double> values;

  int num_rows() const { return static_cast<int>(column_starts.size()) - 1; }
};

// Watches from construction to destruction; one at a time, and only while the engine
// runs on one thread.
class FactorizationWatch {
 public:
  // @param keep  which factorisation's matrix to keep, from 0; negative: none
  explicit FactorizationWatch(int keep = -1);
  ~FactorizationWatch();
  FactorizationWatch(const FactorizationWatch&) = delete;
  FactorizationWatch& operator=(const FactorizationWatch&) = delete;

  int count() const { return count_; }
  // Without columns if there were not that many factorisations.
  const SymmetricMatrix& matrix() const { return matrix_; }

  // The watch that lives now, or null.
  static FactorizationWatch* Active();
  // `matrix` is a cholmod_sparse of the engine's.
  void See(const void* matrix);

 private:
  int keep_;
  int count_ = 0;
  SymmetricMatrix matrix_;
};

}  // namespace dpe::bench

#endif  // DPE_TESTS_BENCHMARKS_FACTORIZATION_WATCH_H_
