// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "mujoco.h"

#include <fmt/format.h>
#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <functional>
#include <span>
#include <utility>

#include "error.h"
#include "timing.h"

namespace scanworld::sim {

namespace {

// Groups of geoms: rays choose by them.
constexpr int kTouched = 0, kSeen = 1, kMovers = 2;

// The most triangles that a mesh to be seen has: MuJoCo 2.2 has no tree of them, only a box around
// each mesh.
constexpr std::ptrdiff_t kMostOfPiece = 32;
using Corners = std::array<int, 3>;

// Of two geoms the one of higher priority says what the friction is: the place's, with the product;
// among robots it is theirs.
std::string surface_text(int group, double friction) {
  return fmt::format("group='{}' priority='{}' condim='{}' friction='{} 0 0'", group,
                     group == kTouched ? 1 : 0, friction > 0 ? 3 : 1, text_of(friction));
}

// The model in MuJoCo's own format. Nothing in it has a name of the caller's.
class MujocoModel {
 public:
  MujocoModel(const Place& place, const RobotOptions& robot, const EngineOptions& options)
      : robot_(robot) {
    header_ = fmt::format(
        "<compiler angle='radian'/><option gravity='0 0 {}'/><default>"
        "<default class='touched'><geom {}/></default><default class='mover'><geom {}/></default>"
        "<default class='seen'><geom group='{}' contype='0' conaffinity='0'/></default></default>",
        place.sort == Sort::empty ? "0" : text_of(-options.gravity),
        surface_text(kTouched, options.friction * robot.friction),
        surface_text(kMovers, robot.friction * robot.friction), kSeen);
    if (place.sort == Sort::plane)
      bodies_ += fmt::format("<geom class='touched' type='plane' size='0 0 1' pos='0 0 {}'/>",
                             text_of(place.height));
    for (const ExportBody& solid : place.solids) add_solid(solid);
    std::vector<Corners> triangles = place.seen.triangles;
    if (!triangles.empty()) add_seen(place.seen, triangles);
  }

  void add_robot(const Pose& pose) {
    const double half = robot_.size / 2;
    bodies_ += fmt::format("<body pos='{}' quat='{}'><freejoint/>", text_of(pose.position),
                           wxyz_text(pose.rotation));
    if (robot_.kind == RobotKind::ball)
      bodies_ +=
          fmt::format("<geom class='mover' type='sphere' size='{}' mass='1'/>", text_of(half));
    else
      bodies_ += box_text(Vec3::Constant(half), 1);
    if (robot_.kind == RobotKind::module) add_arm();
    bodies_ += "</body>";
  }

  std::string text() const {
    return fmt::format(
        "<mujoco>{}<asset>{}</asset><worldbody>{}</worldbody><actuator>{}</actuator></mujoco>",
        header_, assets_, bodies_, motors_);
  }

 private:
  // Returns the attributes of a geom that is this mesh; without triangles, of its hull.
  std::string mesh_text(const Mesh& mesh) {
    const std::string name = fmt::format("mesh_{}", meshes_++);
    assets_ += fmt::format("<mesh name='{}' vertex='", name);
    for (const Vec3& v : mesh.vertices) assets_ += text_of(v) + " ";
    assets_ += "'";
    if (!mesh.triangles.empty()) assets_ += " face='";
    for (const auto& [a, b, c] : mesh.triangles) assets_ += fmt::format("{} {} {} ", a, b, c);
    assets_ += mesh.triangles.empty() ? "/>" : "'/>";
    return fmt::format("type='mesh' mesh='{}'", name);
  }

  void add_solid(const ExportBody& solid) {
    std::string shape;
    if (const auto* box = std::get_if<BoxShape>(&solid.shape))
      shape = fmt::format("type='box' size='{}'", text_of(Vec3(box->size / 2)));
    else if (const auto* cylinder = std::get_if<CylinderShape>(&solid.shape))
      shape = fmt::format("type='cylinder' size='{} {}'", text_of(cylinder->radius),
                          text_of(cylinder->height / 2));
    else
      shape = mesh_text({.vertices = std::get<ConvexShape>(solid.shape).mesh.vertices});
    bodies_ += fmt::format("<geom class='touched' pos='{}' quat='{}' {}/>", text_of(solid.position),
                           wxyz_text(solid.rotation), shape);
  }

  // Halves what is too much for one mesh.
  void add_seen(const Mesh& mesh, std::span<Corners> triangles) {
    if (std::ssize(triangles) <= kMostOfPiece) return add_piece(mesh, triangles);
    const auto middle = [&](const Corners& t) -> Vec3 {
      return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3;
    };
    Box3 box;
    for (const Corners& t : triangles) box.extend(middle(t));
    int axis = 0;
    box.sizes().maxCoeff(&axis);
    const std::size_t half = triangles.size() / 2;
    std::ranges::nth_element(triangles, triangles.begin() + std::ptrdiff_t(half), {},
                             [&](const Corners& t) { return middle(t)[axis]; });
    add_seen(mesh, triangles.first(half));
    add_seen(mesh, triangles.subspan(half));
  }

  // MuJoCo leaves out flat meshes without a word, so each gets a speck that stands up behind it.
  void add_piece(const Mesh& mesh, std::span<const Corners> triangles) {
    constexpr double kSpeck = 0.002;  // [m]
    Mesh piece;
    Vec3 corner = Vec3::Zero(), along = corner, normal = corner;
    const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
      const int first = static_cast<int>(piece.vertices.size());
      piece.vertices.insert(piece.vertices.end(), {a, b, c});
      piece.triangles.push_back({first, first + 1, first + 2});
    };
    for (const auto& [i, j, k] : triangles) {
      const Vec3 &a = mesh.vertices[i], &b = mesh.vertices[j], &c = mesh.vertices[k];
      add(a, b, c);
      if (const Vec3 n = (b - a).cross(c - a); n.norm() > normal.norm())
        corner = a, along = b - a, normal = n;
    }
    if (normal.isZero(0)) return;
    add(corner, corner - kSpeck * normal.normalized(), corner + kSpeck * along.normalized());
    bodies_ += fmt::format("<geom class='seen' {}/>", mesh_text(piece));
  }

  static std::string box_text(const Vec3& half, double mass) {
    return fmt::format("<geom class='mover' type='box' size='{}' mass='{}'/>", text_of(half), mass);
  }

  // The masses and sizes are those of the Symbrion modules, as in the Bullet adapter. Motor and
  // damping together hold the speed: damping is solved for, so nothing swings at long steps; at
  // 2 rad/s they have the modules' force. The stops are hard, else the motor pushes through.
  void add_arm() {
    const std::string hinge = fmt::format("hinge_{}", hinges_++);
    const double strength = 100 * robot_.size, ahead = 0.75 * robot_.size;
    bodies_ += fmt::format(
        "<body pos='{0} 0 0'><joint name='{1}' type='hinge' axis='0 -1 0' pos='-{0} 0 0' "
        "damping='{3}' limited='true' range='-{2} {2}' solreflimit='0.005 1' "
        "solimplimit='0.99 0.99 0.01'/>{4}</body>",
        text_of(ahead), hinge, text_of(M_PI / 2), text_of(strength),
        box_text(robot_.size / 2 * Vec3(0.17, 1, 1), 0.2));
    motors_ += fmt::format("<motor joint='{}' gear='{}'/>", hinge, text_of(strength));
  }

  RobotOptions robot_;
  int meshes_ = 0, hinges_ = 0;
  std::string header_, assets_, bodies_, motors_;
};

struct MujocoDeleter {
  void operator()(mjModel* model) const { mj_deleteModel(model); }
  void operator()(mjData* data) const { mj_deleteData(data); }
  void operator()(mjVFS* files) const {
    mj_deleteVFS(files);
    delete files;
  }
};
template <typename T>
using MujocoPtr = std::unique_ptr<T, MujocoDeleter>;

// Where MuJoCo would end the program, or write a file. Warnings are counted in mjData as well.
void prepare_mujoco() {
  [[maybe_unused]] static const bool once = [] {
    mju_user_error = [](const char* text) {
      throw Error(Cause::failure, std::string("MuJoCo: ") + text);
    };
    mju_user_warning = [](const char*) {};
    return true;
  }();
}

MujocoPtr<mjModel> compiled(const std::string& text) {
  constexpr const char* kName = "place.xml";
  const MujocoPtr<mjVFS> files(new mjVFS);
  mj_defaultVFS(files.get());
  mj_makeEmptyFileVFS(files.get(), kName, static_cast<int>(text.size()));
  std::memcpy(files->filedata[0], text.data(), text.size());
  char error[1000] = "";
  MujocoPtr<mjModel> model(mj_loadXML(kName, files.get(), error, sizeof(error)));
  if (!model) throw Error(Cause::failure, std::string("MuJoCo: ") + error);
  for (int i = 0; i < model->ngeom; ++i)
    if (model->geom_group[i] == kSeen && model->geom_rbound[i] == 0)
      throw Error(Cause::failure, "MuJoCo: it leaves out a mesh that is flat");
  return model;
}

// While it lives, MuJoCo times the parts of its steps.
class MujocoClock {
 public:
  MujocoClock() : before_(std::exchange(mjcb_time, now)) {}
  ~MujocoClock() { mjcb_time = before_; }

 private:
  static double now() {
    static thread_local const Stopwatch watch;
    return watch.cpu();
  }
  mjfTime before_;
};

class Mujoco : public Simulation {
 public:
  Mujoco(MujocoPtr<mjModel> model, const std::vector<Pose>& robots, bool has_arms, bool sees_mesh)
      : model_(std::move(model)), has_arms_(has_arms), sees_mesh_(sees_mesh) {
    const int moving = static_cast<int>(robots.size()), arms = has_arms ? moving : 0;
    reserve(100 + 6 * (moving + arms), 100 + 16 * moving + 12 * arms);
    for (std::size_t i = 0; i < robots.size(); ++i) put(i, robots[i], Vec3::Zero(), Vec3::Zero());
    collide();
  }

  void step(double seconds) override {
    model_->opt.timestep = seconds;
    with_space([&] { mj_step1(model_.get(), data_.get()); });
    mj_step2(model_.get(), data_.get());
    mju_zero(data_->xfrc_applied, 6 * model_->nbody);
    // It goes on from the start where numbers were bad, and says so.
    for (int i = 0; i < mjNWARNING; ++i)
      if (const mjWarningStat& warning = data_->warning[i]; warning.number > 0)
        throw Error(Cause::failure, std::string("MuJoCo: ") + mju_warningText(i, warning.lastinfo));
  }

  void collide() override {
    with_space([&] {
      mj_kinematics(model_.get(), data_.get());
      mj_comPos(model_.get(), data_.get());
      mj_collision(model_.get(), data_.get());
    });
  }

  std::size_t contacts() const override { return static_cast<std::size_t>(data_->ncon); }

  Vec3 position(std::size_t robot) const override { return Vec3::Map(qpos(robot)); }
  Vec3 velocity(std::size_t robot) const override { return Vec3::Map(qvel(robot)); }

  void put(std::size_t robot, const Pose& pose, const Vec3& velocity, const Vec3& spin) override {
    const Eigen::Quaterniond& q = pose.rotation;
    mjtNum *at = qpos(robot), *speed = qvel(robot);
    Vec3::Map(at) = pose.position;
    Eigen::Vector4d::Map(at + 3) << q.w(), q.vec();
    Vec3::Map(speed) = velocity;
    Vec3::Map(speed + 3) = q.conjugate() * spin;
    if (has_arms_) at[7] = speed[6] = 0;
    mju_zero(force(robot), 6);
  }

  void push(std::size_t robot, const Vec3& push) override { Vec3::Map(force(robot)) += push; }

  void bend(std::size_t robot, double speed) override {
    if (has_arms_) data_->ctrl[robot] = speed;
  }

  double cast(const Vec3& from, const Vec3& to) override {
    const Vec3 way = to - from;
    if (way.isZero(0)) return 1;
    int geom = -1;
    const mjtByte groups[mjNGROUP] = {!sees_mesh_, sees_mesh_, 0, 0, 0, 0};
    const double share =
        mj_ray(model_.get(), data_.get(), from.data(), way.data(), groups, 1, -1, &geom);
    return share < 0 ? 1 : std::min(1., share);
  }

  Phases step_by_phases(double seconds) override {
    const MujocoClock clock;
    const Phases start = told();
    step(seconds);
    const Phases end = told();
    return {.narrowphase = end.narrowphase - start.narrowphase,
            .solver = end.solver - start.solver};
  }

 private:
  mjtNum* qpos(std::size_t robot) const { return data_->qpos + robot * (has_arms_ ? 8 : 7); }
  mjtNum* qvel(std::size_t robot) const { return data_->qvel + robot * (has_arms_ ? 7 : 6); }
  mjtNum* force(std::size_t robot) const {
    return data_->xfrc_applied + 6 * (1 + robot * (has_arms_ ? 2 : 1));
  }

  // Of all steps so far.
  Phases told() const {
    const auto time = [&](mjtTimer part) { return data_->timer[part].duration; };
    return {
        .narrowphase = time(mjTIMER_POS_COLLISION),
        .solver = time(mjTIMER_POS_MAKE) + time(mjTIMER_POS_PROJECT) + time(mjTIMER_CONSTRAINT)};
  }

  // Does what finds contacts and the rows of their equations, again where there were more than it
  // has space for.
  void with_space(const std::function<void()>& find) {
    for (;;) {
      find();
      const bool few_contacts = data_->warning[mjWARN_CONTACTFULL].number > 0,
                 few_rows = data_->warning[mjWARN_CNSTRFULL].number > 0;
      if (!few_contacts && !few_rows) return;
      reserve(few_contacts ? 2 * model_->nconmax : model_->nconmax,
              few_rows ? model_->njmax + model_->njmax / 2 : model_->njmax);
    }
  }

  // MuJoCo 2.2 takes all memory at once: the square of the rows and of the degrees of freedom.
  void reserve(int contacts, int rows) {
    const int nv = model_->nv;
    model_->nconmax = contacts, model_->njmax = rows;
    model_->nstack = 100000 + 8 * nv * nv + 100 * rows;
    MujocoPtr<mjData> data(mj_makeData(model_.get()));
    if (!data)
      throw Error(Cause::failure,
                  fmt::format("MuJoCo: too little memory for {} contacts", contacts));
    const MujocoPtr<mjData> old = std::exchange(data_, std::move(data));
    if (!old) return;
    mju_copy(data_->qpos, old->qpos, model_->nq);
    mju_copy(data_->qvel, old->qvel, nv);
    mju_copy(data_->qacc_warmstart, old->qacc_warmstart, nv);
    mju_copy(data_->ctrl, old->ctrl, model_->nu);
    mju_copy(data_->xfrc_applied, old->xfrc_applied, 6 * model_->nbody);
    std::ranges::copy(old->timer, data_->timer);
  }

  MujocoPtr<mjModel> model_;
  MujocoPtr<mjData> data_;
  bool has_arms_, sees_mesh_;
};

}  // namespace

std::unique_ptr<Simulation> make_mujoco(const Place& place, const std::vector<Pose>& robots,
                                        const RobotOptions& robot, const EngineOptions& options) {
  prepare_mujoco();
  if (place.solids.empty() && !place.seen.triangles.empty())
    throw Error(Cause::usage, place.name + ": a mesh, of which MuJoCo would take the convex hull");
  MujocoModel model(place, robot, options);
  for (const Pose& pose : robots) model.add_robot(pose);
  return std::make_unique<Mujoco>(compiled(model.text()), robots, robot.kind == RobotKind::module,
                                  !place.seen.triangles.empty());
}

}  // namespace scanworld::sim
