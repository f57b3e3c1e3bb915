// Creates models from files. The command line passes this object on with the list of models.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "base/files/file_error.h"
#include "emulator/device/model.h"

namespace understudy::emulator::models::imported {
class ImportedModel;
}

namespace understudy::emulator::model_file {

class DescribedModels final : public ModelFiles {
 public:
  /// `house` contains the built-in models, whose names are taken.
  explicit DescribedModels(ModelList house);
  ~DescribedModels() override;

  const Model& load(const std::string& path, std::vector<FileClaim>& files) override;
  const Model& parse(const std::string& text, const std::string& name) override;
  std::vector<FileError::Diagnostic> remarks_on(const Model& model) const override;

 private:
  const Model& read(const std::string& text, const std::string& name, bool may_read,
                    std::vector<FileClaim>& files);

  const ModelList house_;
  mutable std::mutex mutex_;
  std::map<std::string, std::unique_ptr<models::imported::ImportedModel>> models_;  // by description
};

}  // namespace understudy::emulator::model_file
