// Parameters and blocks in the field's words: "the stiffness of spring 17 of object 0
// (vertices 3-15)".
#ifndef DPE_ESTIMATION_UNCERTAINTY_NAMES_H_
#define DPE_ESTIMATION_UNCERTAINTY_NAMES_H_

#include <string>
#include <vector>

#include "dpe/engine/parameters.h"
#include "dpe/engine/scene.h"

namespace dpe {

// Of every parameter of the layout, with article.
std::vector<std::string> ParameterNames(const Scene& scene,
                                        const ParameterLayout& layout);

// "stiffness", "mass", "wind strength", ...: a block as a whole, without article.
std::string BlockQuantity(ParameterKind kind);

// " of object 0", or nothing for the scene's own.
std::string OfObject(int object);

// " of object 0 in capture 2": also of which capture (segment 1), if a block is one's
// alone.
std::string OfBlock(const ParameterBlock& block);

// "a", "a and b", "a, b and c".
std::string Listed(const std::vector<std::string>& parts);

// "12", "3.2e-07": three digits.
std::string Short(double value);

// What the standard deviation of a logarithm means, after the word "to": "12 %", "a
// factor of 3.4".
std::string RelativeSpread(double deviation);

// The same of `deviation` in natural units, each of `size` SI units: "9.1 m/s".
// @param kind  RelativeSpread for positive kinds
std::string Spread(ParameterKind kind, double deviation, double size);

}  // namespace dpe

#endif  // DPE_ESTIMATION_UNCERTAINTY_NAMES_H_
