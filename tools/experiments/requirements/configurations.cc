// Every configuration whose cost is counted, a line each.
#include <utility>

#include "experiments/requirements/features.h"

namespace dpe::experiments {
namespace {

using Arguments = std::vector<std::pair<std::string, Record::Value>>;

Job NewJob(const std::string& id, const Arguments& common, const Arguments& own) {
  Job job;
  job.Set("id", id);
  job.Set("kind", "cost");
  for (const auto& [key, value] : common) job.Set(key, value);
  for (const auto& [key, value] : own) job.Set(key, value);
  return job;
}

std::string Text(const char* text) { return text; }

// A standing cloth of 12 x 12 vertices, 20 frames; springs and gravity alone.
void AddSimulations(std::vector<Job>* jobs) {
  const auto add = [jobs](const std::string& id, const Arguments& own) {
    jobs->push_back(NewJob("sim-" + id, {{"program", Text("simulate_cloth")}}, own));
  };
  const Record::Value yes = true;
  add("bare", {});
  add("unmentioned", {{"unmentioned", Text("damping,printTimes,windVel")}});
  add("drag_off", {{"triangles", yes}, {"wind", 10.0}});
  add("drag_on", {{"triangles", yes}, {"drag", 0.1}});
  add("wind_unmentioned",
      {{"triangles", yes}, {"drag", 0.1}, {"unmentioned", Text("windVel")}});
  add("wind_on", {{"triangles", yes}, {"drag", 0.1}, {"wind", 10.0}});
  add("damping_on", {{"damping", 0.1}});
  add("collider_soft", {{"colliders", std::int64_t{1}}, {"collider_stiffness", 0.0}});
  add("collider_far", {{"colliders", std::int64_t{1}}});
  add("collider_contact", {{"colliders", std::int64_t{1}}, {"contact", yes}});
  add("two_objects", {{"objects", std::int64_t{2}}});
  add("times_off", {{"flags", Text("--print_times=false")}});
  add("times_on", {{"flags", Text("--print_times")}});
}

// A cloth of 6 x 6 vertices with all forces; one iteration over 8 frames.
Arguments CommonOfFits() {
  return {{"program", Text("estimate_cloth")},
          {"rows", std::int64_t{6}},
          {"frames", std::int64_t{8}},
          {"time_frames", std::int64_t{100}},
          {"triangles", true},
          {"drag", 0.1},
          {"damping", 0.1},
          {"wind", 10.0},
          {"groups", true}};
}

// Of quantities, beside the damping, which is always estimated.
void AddQuantities(std::vector<Job>* jobs) {
  const auto add = [jobs](const std::string& id, const std::string& settings,
                          const std::string& estimate) {
    jobs->push_back(NewJob("fit-" + id, CommonOfFits(),
                           {{"settings", settings},
                            {"flags", "--uncertainty=off --estimate=" + estimate}}));
  };
  add("damping", "nn", "damping");
  for (const std::string mode : {"G", "R", "L"}) {
    add("mass_" + mode, mode + "n", "damping");
    add("stiffness_" + mode, "n" + mode, "damping");
  }
  add("drag", "nn", "damping,drag");
  add("wind", "nn", "damping,wind");
  add("initial_velocity", "nn", "damping,initial_velocity");
  jobs->push_back(NewJob("fit-stiffness_alone", CommonOfFits(),
                         {{"flags", Text("--uncertainty=off")}}));
}

// Of options, of one stiffness for all springs or (L) one for each.
void AddOptions(std::vector<Job>* jobs) {
  const auto add = [jobs](const std::string& id, const std::string& flags,
                          const Arguments& own = {}) {
    Arguments arguments = own;
    arguments.emplace_back("flags", flags);
    jobs->push_back(NewJob("fit-" + id, CommonOfFits(), arguments));
  };
  const Arguments two = {{"objects", std::int64_t{2}}, {"settings", Text("nG,nn")}};
  const Arguments both = {{"objects", std::int64_t{2}}, {"settings", Text("nG,nG")}};
  add("second_fixed", "--uncertainty=off", two);
  add("second_on", "--uncertainty=off", both);
  const Arguments validation = {{"count", Text("validation")}};
  add("validation_unmentioned", "--uncertainty=off", validation);
  add("validation_off", "--uncertainty=off --validate_frames=0", validation);
  add("validation_on", "--uncertainty=off --validate_frames=200", validation);
  const Arguments local = {{"settings", Text("nL")}};
  add("uncertainty_off", "--uncertainty=off", local);
  add("uncertainty_auto", "--uncertainty=auto", local);
  add("uncertainty_on", "--uncertainty=on", local);
  add("checkpoint_off", "--uncertainty=off --checkpoint=");
  add("checkpoint_on", "--uncertainty=off --checkpoint={}.checkpoint");
  add("times_off", "--uncertainty=off --print_times=false");
  add("times_on", "--uncertainty=off --print_times");
  const std::string sigma = "--uncertainty=off --sigma=1e-3";
  add("sigma", sigma);
  add("loss_off", sigma + " --loss=none");
  add("loss_on", sigma + " --loss=huber");
  add("prior_off", sigma + " --prior=");
  add("prior_on", sigma + " --prior=stiffness:lognormal:25,1");
  add("sigma_L", sigma, local);
  add("smoothness_off", sigma + " --smoothness=", local);
  add("smoothness_on", sigma + " --smoothness=stiffness=100", local);
}

}  // namespace

std::vector<Job> CostConfigurations() {
  std::vector<Job> jobs;
  AddSimulations(&jobs);
  AddQuantities(&jobs);
  AddOptions(&jobs);
  return jobs;
}

}  // namespace dpe::experiments
