// Sparse LU factorisation without pivoting, of a matrix with the symmetric structure of
// a BlockPattern: A = L U, L with unit diagonal.
//
// The step matrix A = M - h D - h^2 K is nearly symmetric, and its symmetric part is
// positive definite unless springs are strongly compressed; then elimination without
// pivoting is stable (Golub & Van Loan 2013, section 4.3.2: growth is bounded by how
// large the skew part is against the symmetric one). It also serves most indefinite
// matrices, but without that guarantee: the caller checks residuals.
//
// Supernode by supernode (supernodal_structure.h), with the panels of L and of U^T side
// by side. With a supernode's own columns 1 and the rows below 2:
//   [A11 A12; A21 A22] = [L11 0; L21 I] [U11 U12; 0 S],   S = A22 - L21 U12,
// and S is the remainder that goes to the parent. L11 and U11 share a square; L21 and
// U12^T lie each by itself. Columns are split in halves: the left half is factorised,
// the right one updated, then factorised.
//
// Of a symmetric matrix U = D L^T, D the pivots: then U12^T = L21 D is made where it is
// needed and not kept, and of remainders only the lower triangle is made. That halves
// the work and the memory.
#ifndef DPE_ENGINE_LINEAR_SUPERNODAL_LU_H_
#define DPE_ENGINE_LINEAR_SUPERNODAL_LU_H_

#include <memory>
#include <vector>

#include "linear/supernodal_panels.h"
#include "linear/supernodal_solve.h"
#include "linear/supernodal_structure.h"

namespace dpe {

class SupernodalLu {
 public:
  // @param structure  shared by all factorisations of one pattern
  explicit SupernodalLu(std::shared_ptr<const SupernodalStructure> structure);

  // Factorises the matrix whose values, in pattern order, are given.
  //
  // @param symmetric  the matrix is symmetric; its upper triangle is then not read
  // @param work       resized as needed; may be shared by factorisations that take
  //                   turns
  // @param copy       if not null, receives the same factors
  // @return           false if a pivot is zero or not finite
  bool Factorize(const double* values, bool symmetric, std::vector<double>* work,
                 SupernodalPanels* copy = nullptr);

  // For SolveSupernodal; valid until the next factorisation.
  SupernodalFactor factor() const { return panels_.factor(*structure_); }

 private:
  void CopyPanels(int s, SupernodalPanels* copy) const;
  void Assemble(int s, const double* values);
  void AddToPanels(int child, int s, const double* remainder);
  void MakeRemainder(int s, double* work);
  void MakeSymmetricRemainder(int s, double* scaled, double* remainder);
  void AddToRemainder(int child, int s, const double* in, double* remainder);
  bool FactorizeColumns(int s, int begin, int end);
  void UpdateColumns(int s, int begin, int middle, int end);
  bool FactorizePanel(int s, int begin, int end);
  double* LowerPanel(int s) const {
    return panels_.lower() + structure_->value_start[s];
  }
  // The panel of U^T; null if symmetric.
  double* UpperPanel(int s) const {
    return symmetric_ ? nullptr : panels_.upper() + structure_->upper_start[s];
  }

  std::shared_ptr<const SupernodalStructure> structure_;
  bool symmetric_ = false;
  SupernodalPanels panels_;
};

}  // namespace dpe

#endif  // DPE_ENGINE_LINEAR_SUPERNODAL_LU_H_
