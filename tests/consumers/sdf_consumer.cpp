// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A world in SDF as Gazebo takes it: read by libsdformat, where a warning is an error; simulated by
// DART, through ignition-physics. Rays meet the collisions, in Bullet.
#include <filesystem>
#include <ignition/common/Mesh.hh>
#include <ignition/common/MeshManager.hh>
#include <ignition/common/SubMesh.hh>
#include <ignition/math/eigen3/Conversions.hh>
#include <ignition/physics/FindFeatures.hh>
#include <ignition/physics/ForwardStep.hh>
#include <ignition/physics/FrameSemantics.hh>
#include <ignition/physics/GetEntities.hh>
#include <ignition/physics/RequestEngine.hh>
#include <ignition/physics/mesh/MeshShape.hh>
#include <ignition/physics/sdf/ConstructCollision.hh>
#include <ignition/physics/sdf/ConstructModel.hh>
#include <ignition/physics/sdf/ConstructWorld.hh>
#include <ignition/plugin/Loader.hh>
#include <memory>
#include <sdf/sdf.hh>

#include "bullet_rays.h"

namespace {

namespace physics = ignition::physics;

struct Features
    : physics::FeatureList<physics::ForwardStep, physics::LinkFrameSemantics, physics::GetEntities,
                           physics::sdf::ConstructSdfWorld, physics::sdf::ConstructSdfModel,
                           physics::mesh::AttachMeshShapeFeature> {};

btVector3 vector_of(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

btTransform transform_of(const ignition::math::Pose3d& pose) {
  const auto& q = pose.Rot();
  return btTransform(btQuaternion(q.X(), q.Y(), q.Z(), q.W()), vector_of(pose.Pos()));
}

std::string ball_sdf(double radius, const Triple& at) {
  std::ostringstream text;
  text << "<sdf version='1.7'><model name='ball_" << at << "'><pose>" << at << " 0 0 0</pose>"
       << "<link name='link'><inertial><mass>1</mass><inertia><ixx>0.004</ixx><iyy>0.004</iyy>"
       << "<izz>0.004</izz></inertia></inertial><collision name='c'><geometry><sphere><radius>"
       << radius << "</radius></sphere></geometry></collision></link></model></sdf>";
  return text.str();
}

class Sdf : public Consumer {
 public:
  explicit Sdf(const std::string& file) : folder_(std::filesystem::path(file).parent_path()) {
    sdf::ParserConfig config;
    config.SetWarningsPolicy(sdf::EnforcementPolicy::ERR);
    config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::ERR);
    config.SetDeprecatedElementsPolicy(sdf::EnforcementPolicy::ERR);
    config.AddURIPath("model://", folder_.string());
    const sdf::Errors errors = root_.Load(file, config);
    if (!errors.empty()) throw std::runtime_error(errors[0].Message());
    model_ = root_.WorldByIndex(0)->ModelByIndex(0);
    if (!model_->Static()) throw std::runtime_error("the model is not static");
    const sdf::Link& link = *model_->LinkByIndex(0);
    for (std::size_t i = 0; i < link.CollisionCount(); ++i) add(*link.CollisionByIndex(i));
    if (link.VisualCount() > 0)
      seen_.add_triangles(btTransform::getIdentity(),
                          corners_of(mesh_of(*link.VisualByIndex(0)->Geom()->MeshShape())));
    make_dart();
  }

  std::vector<std::string> names() override { return names_; }
  Triple gravity() override {
    const auto g = root_.WorldByIndex(0)->Gravity();
    return {g.X(), g.Y(), g.Z()};
  }

  double ray(const Triple& from, const Triple& direction, Meets what) override {
    return (what == Meets::seen ? seen_ : solids_).cast(from, direction);
  }

  std::vector<Triple> drop(double radius, double seconds,
                           const std::vector<Triple>& from) override {
    std::vector<physics::Link3dPtr<Features>> balls;
    for (const Triple& start : from) {
      sdf::Root root;
      if (!root.LoadSdfString(ball_sdf(radius, start)).empty()) throw std::runtime_error("ball");
      balls.push_back(world_->ConstructModel(*root.Model())->GetLink(0));
    }
    physics::ForwardStep::Input input;
    physics::ForwardStep::State state;
    physics::ForwardStep::Output output;
    for (int i = 0; i < static_cast<int>(std::lround(1000 * seconds)); ++i)
      world_->Step(output, state, input);
    std::vector<Triple> ends;
    for (const auto& ball : balls) {
      const auto p = ball->FrameDataRelativeToWorld().pose.translation();
      ends.push_back({p.x(), p.y(), p.z()});
    }
    return ends;
  }

 private:
  const ignition::common::Mesh& mesh_of(const sdf::Mesh& shape) {
    const std::string uri = shape.Uri(), start = "model://";
    const auto file = folder_ / uri.substr(start.size());
    const auto* mesh = ignition::common::MeshManager::Instance()->Load(file.string());
    if (!mesh) throw std::runtime_error("no mesh at " + uri);
    return *mesh;
  }

  // Adds a collision for rays.
  void add(const sdf::Collision& collision) {
    names_.push_back(collision.Name());
    const sdf::Geometry& shape = *collision.Geom();
    const auto ode =
        collision.Element()->GetElement("surface")->GetElement("friction")->GetElement("ode");
    if (std::abs(ode->Get<double>("mu") - 0.8) > 1e-9) throw std::runtime_error("another friction");
    const btTransform at = transform_of(collision.RawPose());
    if (const auto* box = shape.BoxShape())
      solids_.add_box(at, vector_of(box->Size()));
    else if (const auto* cylinder = shape.CylinderShape())
      solids_.add_cylinder(at, cylinder->Radius(), cylinder->Length());
    else
      solids_.add_triangles(at, corners_of(mesh_of(*shape.MeshShape())));
  }

  static std::vector<btVector3> corners_of(const ignition::common::Mesh& mesh) {
    std::vector<btVector3> corners;
    for (unsigned s = 0; s < mesh.SubMeshCount(); ++s) {
      const auto sub = mesh.SubMeshByIndex(s).lock();
      for (unsigned i = 0; i < sub->IndexCount(); ++i)
        corners.push_back(vector_of(sub->Vertex(static_cast<unsigned>(sub->Index(i)))));
    }
    return corners;
  }

  void make_dart() {
    ignition::plugin::Loader loader;
    loader.LoadLib(DARTSIM_PLUGIN);
    const auto plugin = loader.Instantiate("ignition::physics::dartsim::Plugin");
    const auto engine = physics::RequestEngine3d<Features>::From(plugin);
    if (!engine) throw std::runtime_error("no DART");
    world_ = engine->ConstructWorld(*root_.WorldByIndex(0));
    const auto link = world_->GetModel(0)->GetLink(0);
    // As Gazebo does, which loads meshes itself.
    const sdf::Link& source = *model_->LinkByIndex(0);
    for (std::size_t i = 0; i < source.CollisionCount(); ++i) {
      const sdf::Collision& c = *source.CollisionByIndex(i);
      if (const auto* mesh = c.Geom()->MeshShape())
        link->AttachMeshShape(c.Name(), mesh_of(*mesh),
                              ignition::math::eigen3::convert(c.RawPose()));
    }
  }

  std::filesystem::path folder_;
  sdf::Root root_;
  const sdf::Model* model_ = nullptr;
  std::vector<std::string> names_;
  physics::World3dPtr<Features> world_;
  BulletRays seen_, solids_;
};

}  // namespace

int main(int argc, char** argv) {
  return serve(argc, argv, [](const std::string& file) { return std::make_unique<Sdf>(file); });
}
