// The triangular factor of a tall matrix whose rows come in chunks.
//
//   A = Q R,  A: m x n, m >> n,  R: n x n upper triangular,  R^T R = A^T A
//
// without forming A^T A, which would square the condition number, and without ever
// holding A. Rows are folded into R a chunk at a time,
//
//   [R]           [R']
//   [C]  =  Q_C   [0 ],
//
// by Householder reflections that leave the zeros of R alone (LAPACK's dtpqrt): 2 n^2
// operations per row, as in the QR of the whole, but on pieces that stay in the cache.
// So that processors can share the work, chunks are dealt out to several streams, each
// with an R of its own, which are then folded into one another, two by two. How many
// streams there are depends on the shape of A alone, hence the result does not depend
// on the number of threads.
//
// Reflections act on columns of A without mixing their scales: an error of R's column j
// is of the order of rounding times the length of A's column j, however the lengths
// differ. (Demmel, Grigori, Hoemmen & Langou, Communication-optimal parallel and
// sequential QR and LU factorizations, SIAM J. Sci. Comput. 34, 2012.)
#ifndef DPE_ESTIMATION_TALL_QR_H_
#define DPE_ESTIMATION_TALL_QR_H_

#include <Eigen/Core>
#include <functional>
#include <vector>

namespace dpe {

// Chunks of about as many rows are the fastest: at 716 columns 2.9 MB, and panels of 32
// columns that fit into any second-level cache.
constexpr int kRowsPerChunk = 512;

// Chunks of kRowsPerChunk rows, the last of what is left.
std::vector<int> ChunkRows(int num_rows);

// @param chunk_rows    number of rows of each chunk
// @param num_columns   n
// @param num_threads   threads to use
// @param fill          writes a chunk, rows x n, into a column-major matrix that holds
//                      anything; called once per chunk, in no particular order, from
//                      any thread but from one at a time; false gives up
// @param r             n x n, zero below the diagonal; diagonal entries of either sign
// @return              false if `fill` gave up
bool TallQr(
    const std::vector<int>& chunk_rows, int num_columns, int num_threads,
    const std::function<bool(int chunk, Eigen::Ref<Eigen::MatrixXd> rows)>& fill,
    Eigen::MatrixXd* r);

}  // namespace dpe

#endif  // DPE_ESTIMATION_TALL_QR_H_
