// Small scenes that derivative and integrator tests share.
#ifndef DPE_TESTS_SUPPORT_TEST_SCENES_H_
#define DPE_TESTS_SUPPORT_TEST_SCENES_H_

#include <string>
#include <vector>

#include "dpe/engine/scene.h"

namespace dpe::test {

// The scenes of the derivative tests: "side", "corners", "flag" (presets), "collider"
// (a cloth falling on a sphere and a tilted plane), "two_objects" (two cloths in one
// wind, the second with initial velocity, a moving pin and a pin between free
// vertices).
const std::vector<std::string>& DerivativeSceneNames();

// @param resolution  vertices per side
Scene MakeDerivativeScene(const std::string& name, int resolution);

// Marks every kind of parameter as estimated: mass and stiffness with the given mode,
// damping, drag, wind, initial velocities and positions (with rest lengths as they
// are).
void EstimateEverything(ParameterMode mode, Scene* scene);

// Multiplies masses, stiffnesses, damping and drag by exp(0.2 N(0,1)), adds wind and
// initial velocities of about 0.5 m/s: a place away from symmetry and from any truth.
void Perturb(unsigned seed, Scene* scene);

}  // namespace dpe::test

#endif  // DPE_TESTS_SUPPORT_TEST_SCENES_H_
