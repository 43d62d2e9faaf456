// What a job of the kind "cost" describes: a scene, a program and its flags.
#ifndef DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_COST_CONFIGURATION_H_
#define DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_COST_CONFIGURATION_H_

#include <string>
#include <vector>

#include "experiments/experiment.h"

namespace dpe::experiments {

// The scene's file, as text. Without arguments it is a standing cloth of springs under
// gravity and nothing else; each argument adds something:
//   rows              vertices along each edge (12)
//   integrator        method by name or number (linearly_implicit_euler)
//   triangles         true: the surface, which drag needs (false)
//   drag, damping     of every cloth (0)
//   wind              m/s, along x (0)
//   colliders         number of spheres (0); they are far below the cloth unless
//   contact           is true: then they push its middle (false)
//   collider_stiffness  N/m (1000)
//   objects           number of equal cloths (1)
//   groups            true: vertices in two groups, left and right (false)
//   settings          as estimate_cloth's --settings takes it ("nG")
//   unmentioned       keys whose lines are taken out of the file, separated by commas
// @throws SceneError for an argument that is not accepted
std::string CostSceneText(const Job& job);

// The program and its flags for `scene_path`, with results into the folder of
// `output_path`. Arguments:
//   program           simulate_cloth or estimate_cloth (simulate_cloth)
//   flags             more flags, separated by spaces
// An estimation starts near the truth and ends after one iteration: two rollouts, two
// Jacobians, one solution.
// @throws SceneError for an argument that is not accepted
std::vector<std::string> CostCommand(const Job& job, const std::string& scene_path,
                                     const std::string& output_path, int frames);

// The functions that are counted: the simulation or the estimation without reading and
// writing files; with `count` = "validation" the validation, too.
std::vector<std::string> CountedFunctions(const Job& job);

}  // namespace dpe::experiments

#endif  // DPE_TOOLS_EXPERIMENTS_REQUIREMENTS_COST_CONFIGURATION_H_
