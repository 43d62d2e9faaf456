// What is known of the parameters before the data are looked at.
//
// A prior on one unknown p with centre c and spread s is one more residual,
//
//   normal:      (p - c) / s            c, s in p's SI unit
//   log-normal:  (ln p - ln c) / s      c > 0 the median, s the standard deviation of
//                                       ln p: about the relative one where it is small
//
// beside residuals r that are in standard deviations of the noise. 1/2 |r|^2 + 1/2 sum
// of their squares is then, up to a constant, minus the logarithm of the posterior
// density, and its minimum the maximum a posteriori estimate (Tarantola, Inverse
// Problem Theory, 2005, section 3.2). Against residuals in metres a prior would mean
// nothing: the noise has to be known. The density is that of ln p for a log-normal
// prior, whose estimate does not depend on the unit then.
//
// A smoothness prior says of values per element (mode L) that neighbours are alike:
//
//   sqrt(w g) (ln k_a - ln k_b - ln h_a + ln h_b)      for all neighbours a, b      (1)
//
// Neighbours are springs of the same kind that share a vertex (neighbours.h says what
// joins the pieces that this leaves of some kinds), or vertices that a spring joins.
// Logarithms, because the quantities are positive and a material that varies varies by
// factors: (1) does not know in which unit k is nor how large it is, and it is linear
// in the optimiser's coordinates q = ln k.
//
// What is smooth is the material, not the mesh: h is the value that the construction
// rule of cloth_builder.h gives the element for a uniform material, from the geometry
// alone. (On the boundary of a grid springs have half the stiffness and vertices half
// the mass of those inside; (1) with h = 1 would smear that into the cloth.) h = 1 for
// objects whose springs are not those of the rule.
//
// What w means. Over the n elements, q is an intrinsic Gaussian Markov random field
// with precision w g L, L the graph Laplacian (Rue & Held, Gaussian Markov Random
// Fields, 2005, section 3.3). It says nothing about a common factor of what is
// connected. The variance of q_a - q_b under it is R_ab / (w g), R_ab the resistance
// between a and b if every pair is a resistor of 1, and these add up to the number of
// elements less that of connected components c, whatever the graph (Foster, The average
// impedance of an electrical network, 1949). With m pairs and
//
//   g = (n - c) / m                                                               (2)
//
// the mean over all neighbours of the variance of the logarithm of their ratio is 1 /
// w. So w = 100 says: neighbours differ by 10 %, typically. Without g the same w would
// mean less variation the more neighbours a mesh has.
#ifndef DPE_ESTIMATION_PRIORS_H_
#define DPE_ESTIMATION_PRIORS_H_

#include <string>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/estimation/export.h"

namespace dpe {

enum class PriorDistribution { kNormal, kLogNormal };

// On each unknown of a kind by itself, or on some of them.
struct Prior {
  ParameterKind kind = ParameterKind::kStiffness;
  // Which ones. Stiffness: "stretch", "shear", "bend" or the number of a group; mass:
  // the number of a group; wind and initial velocity: "x", "y" or "z". Empty: all.
  std::string part;
  int object = -1;  // -1: all objects of which it is estimated
  PriorDistribution distribution = PriorDistribution::kLogNormal;
  double centre = 1.0;
  double spread = 1.0;
};

struct SmoothnessPrior {
  ParameterKind kind = ParameterKind::kStiffness;  // or kMass
  int object = -1;                                 // -1: all with values per element
  double weight = 0.0;                             // w; 0: none yet, see below
  // The weight is chosen by held-out frames, see SmoothnessCandidate in estimator.h.
  bool is_chosen = false;
};

// Reads "stiffness:lognormal:50,0.5;damping:normal:0.1,0.02": QUANTITY[PART]@OBJECT:
// DISTRIBUTION:CENTRE,SPREAD, of which [PART] and @OBJECT may be left out. Quantities
// are mass, stiffness, damping, drag, wind and initial_velocity.
// @throws SceneError naming the entry and what is accepted
DPE_ESTIMATION_API std::vector<Prior> PriorsFromText(const std::string& text);

// Reads "stiffness=100,mass@1=auto". @throws SceneError likewise
DPE_ESTIMATION_API std::vector<SmoothnessPrior> SmoothnessFromText(
    const std::string& text);

// Text that reads back to the same; a weight that was chosen is "auto:100".
DPE_ESTIMATION_API std::string PriorText(const Prior& prior);
DPE_ESTIMATION_API std::string SmoothnessText(const SmoothnessPrior& smoothness);
DPE_ESTIMATION_API std::string SmoothnessText(
    const std::vector<SmoothnessPrior>& smoothness);

}  // namespace dpe

#endif  // DPE_ESTIMATION_PRIORS_H_
