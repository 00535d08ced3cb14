// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// An MJCF file in MuJoCo. Robots and balls are added as a user would, by a model that includes it.
#include <mujoco/mujoco.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "consumer.h"

namespace {

struct Free {
  void operator()(mjModel* m) const { mj_deleteModel(m); }
  void operator()(mjData* d) const { mj_deleteData(d); }
};

class MuJoCo : public Consumer {
 public:
  explicit MuJoCo(const std::string& file) : file_(file) { load(file); }

  std::vector<std::string> names() override {
    std::vector<std::string> all;
    for (int i = 0; i < model_->ngeom; ++i)
      if (model_->geom_contype[i]) all.push_back(mj_id2name(model_.get(), mjOBJ_GEOM, i));
    return all;
  }
  Triple gravity() override {
    const mjtNum* g = model_->opt.gravity;
    return {g[0], g[1], g[2]};
  }
  double ray(const Triple& from, const Triple& direction, Meets what) override {
    int geom = -1;
    const bool seen = what == Meets::seen;
    const mjtByte groups[mjNGROUP] = {1, 0, seen, !seen, 0, 0};
    return mj_ray(model_.get(), data_.get(), from.data(), direction.data(), groups, 1, -1, &geom);
  }
  bool is_free(const Triple& from, const Triple& to, const Triple& size, double yaw) override {
    std::ostringstream robot;
    robot << R"(<body name="robot"><freejoint/><geom type="box" mass="1" size=")" << size[0] / 2
          << ' ' << size[1] / 2 << ' ' << size[2] / 2 << R"("/></body>)";
    with(robot.str());
    const int steps = 100;
    bool free = true;
    for (int i = 0; i <= steps; ++i) {
      for (std::size_t k = 0; k < 3; ++k) data_->qpos[k] = from[k] + (to[k] - from[k]) * i / steps;
      data_->qpos[3] = std::cos(yaw / 2), data_->qpos[4] = data_->qpos[5] = 0;
      data_->qpos[6] = std::sin(yaw / 2);
      mj_fwdPosition(model_.get(), data_.get());
      for (int c = 0; c < data_->ncon; ++c) free &= data_->contact[c].dist > 0;
    }
    load(file_);
    return free;
  }
  std::vector<Triple> drop(double radius, double seconds,
                           const std::vector<Triple>& from) override {
    std::ostringstream balls;
    for (const Triple& p : from)
      balls
          << "<body pos=\"" << p
          << R"("><freejoint/><geom type="sphere" condim="6" friction="1 0.005 0.01" mass="1" size=")"
          << radius << "\"/></body>";
    with(balls.str());
    while (data_->time < seconds) mj_step(model_.get(), data_.get());
    for (int i = 0; i < mjNWARNING; ++i)
      if (data_->warning[i].number) throw std::runtime_error(mju_warningText(i, 0));
    std::vector<Triple> ends;
    for (std::size_t i = 0; i < from.size(); ++i)
      ends.push_back({data_->qpos[7 * i], data_->qpos[7 * i + 1], data_->qpos[7 * i + 2]});
    load(file_);
    return ends;
  }

 private:
  void load(const std::string& file) {
    char error[1000] = "";
    model_.reset(mj_loadXML(file.c_str(), nullptr, error, sizeof(error)));
    if (!model_ || error[0]) throw std::runtime_error(file + ": " + error);
    data_.reset(mj_makeData(model_.get()));
    mj_forward(model_.get(), data_.get());
  }
  // Loads the world with more bodies in it.
  void with(const std::string& bodies) {
    const std::string file = file_ + ".with.xml";
    std::ofstream(file) << "<mujoco><include file=\""
                        << std::filesystem::path(file_).filename().string() << "\"/><worldbody>"
                        << bodies << "</worldbody></mujoco>";
    load(file);
  }

  std::string file_;
  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
};

}  // namespace

int main(int argc, char** argv) {
  return serve(argc, argv, [](const std::string& file) { return std::make_unique<MuJoCo>(file); });
}
