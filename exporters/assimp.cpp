// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "assimp.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <cmath>
#include <fstream>
#include <memory>

#include "error.h"
#include "files.h"
#include "parts.h"

namespace scanworld {

namespace {

aiVector3D vector(const Vec3& v) {
  return {static_cast<ai_real>(v.x()), static_cast<ai_real>(v.y()), static_cast<ai_real>(v.z())};
}

aiMesh* mesh_of(const ExportPart& part, unsigned material) {
  auto* mesh = new aiMesh;
  mesh->mName = part.name;
  mesh->mMaterialIndex = material;
  mesh->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  mesh->mNumVertices = static_cast<unsigned>(part.mesh.vertices.size());
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];
  for (unsigned i = 0; i < mesh->mNumVertices; ++i)
    mesh->mVertices[i] = vector(part.mesh.vertices[i]);
  mesh->mNumFaces = static_cast<unsigned>(part.mesh.triangles.size());
  mesh->mFaces = new aiFace[mesh->mNumFaces];
  for (unsigned i = 0; i < mesh->mNumFaces; ++i) {
    mesh->mFaces[i].mNumIndices = 3;
    mesh->mFaces[i].mIndices = new unsigned[3];
    for (std::size_t k = 0; k < 3; ++k)
      mesh->mFaces[i].mIndices[k] = static_cast<unsigned>(part.mesh.triangles[i][k]);
  }
  return mesh;
}

aiMaterial* make_material(const ExportPart& part) {
  auto* material = new aiMaterial;
  const aiColor3D color(part.color.r / 255.f, part.color.g / 255.f, part.color.b / 255.f);
  const aiString name(part.name);
  material->AddProperty(&name, AI_MATKEY_NAME);
  material->AddProperty(&color, 1, AI_MATKEY_COLOR_DIFFUSE);
  return material;
}

// The scene owns all that is made with new, as assimp wants it.
std::unique_ptr<aiScene> scene_of(const std::vector<ExportPart>& parts) {
  const unsigned count = static_cast<unsigned>(parts.size());
  auto scene = std::make_unique<aiScene>();
  scene->mNumMeshes = scene->mNumMaterials = count;
  scene->mMeshes = new aiMesh*[count];
  scene->mMaterials = new aiMaterial*[count];
  scene->mRootNode = new aiNode("world");
  scene->mRootNode->mNumChildren = count;
  scene->mRootNode->mChildren = new aiNode*[count];
  for (unsigned i = 0; i < count; ++i) {
    scene->mMeshes[i] = mesh_of(parts[i], i);
    scene->mMaterials[i] = make_material(parts[i]);
    auto* node = new aiNode(parts[i].name);
    node->mParent = scene->mRootNode;
    node->mNumMeshes = 1;
    node->mMeshes = new unsigned[1]{i};
    scene->mRootNode->mChildren[i] = node;
  }
  // The axes, for formats that hold them (Collada): up is Z.
  scene->mMetaData = aiMetadata::Alloc(3);
  scene->mMetaData->Set(0, "UpAxis", 2);
  scene->mMetaData->Set(1, "UpAxisSign", 1);
  scene->mMetaData->Set(2, "UnitScaleFactor", 1.f);
  return scene;
}

void fill_element(std::string& xml, const std::string& tag, const std::string& value) {
  const std::size_t begin = xml.find("<" + tag + ">"), end = xml.find("</" + tag + ">");
  if (begin != std::string::npos && end != std::string::npos)
    xml.replace(begin + tag.size() + 2, end - begin - tag.size() - 2, value);
}

// The file's bytes, in a format by assimp's name for it.
std::string written(const std::filesystem::path& path, const aiScene& scene,
                    const std::string& format) {
  // Through a file, as assimp makes 3MF no other way.
  const ScratchFolder folder(path);
  const std::filesystem::path part = folder.path() / "part";
  Assimp::Exporter exporter;
  if (exporter.Export(&scene, format, part.string()) != aiReturn_SUCCESS)
    throw Error(Cause::failure,
                path.string() + ": assimp cannot write it: " + exporter.GetErrorString());
  std::ifstream file(part, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  return bytes;
}

// Sets the time of all entries of a ZIP archive to its earliest, 1980.
void forget_times(std::string& zip) {
  const std::string local("PK\3\4", 4), central("PK\1\2", 4);
  const std::string time("\0\0\x21\0", 4);
  for (const auto& [mark, offset] : {std::pair(local, 10), std::pair(central, 12)})
    for (std::size_t at = 0; (at = zip.find(mark, at)) != std::string::npos; at += 4)
      if (at + offset + 4 <= zip.size()) zip.replace(at + offset, 4, time);
}

}  // namespace

void write_dae(const std::filesystem::path& path, const World& world,
               const ExportOptions& options) {
  std::string text = written(path, *scene_of(export_parts(world, options)), "collada");
  // The same world gives the same file: not the time of writing.
  for (const char* tag : {"created", "modified"}) fill_element(text, tag, "2000-01-01T00:00:00");
  write_text(path, text);
}

void write_3mf(const std::filesystem::path& path, const World& world,
               const ExportOptions& options) {
  std::vector<ExportPart> parts = export_parts(world, options);
  for (ExportPart& part : parts)
    for (Vec3& v : part.mesh.vertices) v *= 1000;  // the format's unit is the millimetre
  std::string zip = written(path, *scene_of(parts), "3mf");
  forget_times(zip);
  write_text(path, zip);
}

namespace {

constexpr unsigned kProcess = aiProcess_Triangulate | aiProcess_PreTransformVertices;

// assimp takes a line feed at the start of binary data for one of the header (its issue 5341), so
// it gets another one.
const aiScene* read_ply(Assimp::Importer& importer, const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const std::string end = "end_header\n";
  const std::size_t at = bytes.find(end);
  if (at != std::string::npos && bytes.substr(0, at).find("format binary") != std::string::npos &&
      bytes[at + end.size()] == '\n')
    bytes.insert(at + end.size(), "\n");
  return importer.ReadFileFromMemory(bytes.data(), bytes.size(), kProcess, "ply");
}

}  // namespace

Mesh read_mesh(const std::filesystem::path& path) {
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene = lower_extension(path) == ".ply"
                             ? read_ply(importer, path)
                             : importer.ReadFile(path.string(), kProcess);
  if (!scene) throw Error(Cause::bad_input, path.string() + ": " + importer.GetErrorString());
  Mesh mesh;
  std::map<std::array<ai_real, 3>, int> index_of;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      if (part.mFaces[f].mNumIndices != 3) continue;  // points and lines
      std::array<int, 3> triangle{};
      for (unsigned k = 0; k < 3; ++k) {
        const aiVector3D& v = part.mVertices[part.mFaces[f].mIndices[k]];
        if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
          throw Error(Cause::bad_input, path.string() + ": a vertex of triangle " +
                                            std::to_string(mesh.triangles.size() + 1) +
                                            " is not finite");
        const auto [found, is_new] =
            index_of.try_emplace({v.x, v.y, v.z}, static_cast<int>(mesh.vertices.size()));
        if (is_new) mesh.vertices.emplace_back(v.x, v.y, v.z);
        triangle[k] = found->second;
      }
      mesh.triangles.push_back(triangle);
    }
  }
  return mesh;
}

}  // namespace scanworld
