#include "schema.hpp"

#include "running_nacre.hpp"

#include <nlohmann/json.hpp>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>

namespace nacre::test {

void expectMatchesSchema(const std::string& text, const std::string& schema) {
    const std::string schemaText = readText(std::filesystem::path(NACRE_SOURCE_DIR "/docs/schemas") / schema);
    const nlohmann::json schemaJson = nlohmann::json::parse(schemaText);
    const nlohmann::json json = nlohmann::json::parse(text);
    valijson::Schema parsed;
    valijson::SchemaParser().populateSchema(valijson::adapters::NlohmannJsonAdapter(schemaJson), parsed);
    valijson::ValidationResults faults;
    const valijson::adapters::NlohmannJsonAdapter target(json);
    EXPECT_TRUE(valijson::Validator().validate(parsed, target, &faults));
    for (valijson::ValidationResults::Error fault; faults.popError(fault);) {
        std::string where;
        for (const std::string& part : fault.context) {
            where += part;
        }
        ADD_FAILURE() << schema << ": " << where << ": " << fault.description;
    }
}

} // namespace nacre::test
