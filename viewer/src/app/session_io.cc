#include "app/session_io.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace dpe::viewer {
namespace {

using Json = nlohmann::ordered_json;

Json TuningJson(const Tuning& tuning) {
  const ObjectTuning& object = tuning.objects.front();
  return {{"stiffness", object.stiffness_factor},
          {"mass", object.mass_factor},
          {"damping", object.damping},
          {"drag", object.drag_coefficient},
          {"wind", {tuning.wind.x(), tuning.wind.y(), tuning.wind.z()}}};
}

Json State(const Session& session, const WindowState& window) {
  const Player& player = session.player();
  const OrbitCamera& camera = session.camera();
  const auto frame = static_cast<size_t>(player.frame());
  Json json;
  json["frame"] = player.frame();
  json["first_frame"] = player.first_frame();
  json["last_frame"] = player.last_frame();
  json["time_s"] = player.time();
  json["paused"] = player.paused();
  json["live"] = player.is_live();
  json["speed"] = player.speed();
  json["color"] = ColorModeName(session.view().color);
  json["missing"] = session.maker().missing();
  json["camera"] = {
      {"yaw", camera.yaw()},
      {"pitch", camera.pitch()},
      {"distance", camera.distance()},
      {"target", {camera.target().x, camera.target().y, camera.target().z}}};
  json["size"] = {window.width, window.height};
  json["cursor"] = {window.cursor_x, window.cursor_y};
  json["button_down"] = window.button_down;
  json["help"] = session.shows_help();
  const bool known =
      frame < player.errors().size() && std::isfinite(player.errors()[frame]);
  json["error_m"] = known ? Json(player.errors()[frame]) : Json(nullptr);
  json["tuning"] = TuningJson(player.tuning());
  json["widgets"] = Json::object();
  for (const auto& [name, place] : window.widgets)
    json["widgets"]["at_" + name] = place;
  json["message"] = session.message();
  json["failure"] = player.failure();
  return json;
}

std::string Dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string StateJson(const Session& session, const WindowState& window) {
  Json json = State(session, window);
  json["pictures"] = window.pictures;
  json["pictures_per_second"] = window.pictures_per_second;
  json["draft"] = window.is_draft;
  json["frame_ms"] = session.player().frame_ms();
  json["rate"] = session.player().rate();
  json["device"] = window.device;
  return Dump(json);
}

std::string StateKey(const Session& session, const WindowState& window) {
  return Dump(State(session, window));
}

}  // namespace dpe::viewer
