// What is asked of JSON before it is parsed. nlohmann's own callback looks at all earlier elements of an array after
// each new one; this takes a time in proportion.
#pragma once

#include <nlohmann/json.hpp>

#include <functional>
#include <set>
#include <string>
#include <vector>

namespace nacre {

/// Follows the structure of a JSON text (nlohmann's SAX interface): `tooDeep` is called inside of more than `maxDepth`
/// objects and arrays, `repeated` with a key that its object has twice, where it is set. They throw. Syntax is left to
/// the parser.
template <typename Json> class JsonStructure : public nlohmann::json_sax<Json> {
public:
    using Repeated = std::function<void(const std::string& key)>;
    JsonStructure(int maxDepth, std::function<void()> tooDeep, Repeated repeated = nullptr)
        : maxDepth_(maxDepth), tooDeep_(std::move(tooDeep)), repeated_(std::move(repeated)) {}

    bool null() override { return check(); }
    bool boolean(bool) override { return check(); }
    bool number_integer(typename Json::number_integer_t) override { return check(); }
    bool number_unsigned(typename Json::number_unsigned_t) override { return check(); }
    bool number_float(typename Json::number_float_t, const typename Json::string_t&) override { return check(); }
    bool string(typename Json::string_t&) override { return check(); }
    bool binary(typename Json::binary_t&) override { return check(); }
    bool start_object(std::size_t) override { return open(); }
    bool end_object() override { return close(); }
    bool start_array(std::size_t) override { return open(); }
    bool end_array() override { return close(); }
    bool key(typename Json::string_t& key) override {
        check();
        if (repeated_ && !keys_.back().insert(key).second) {
            repeated_(key);
        }
        return true;
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }

private:
    bool check() const {
        if (keys_.size() > static_cast<std::size_t>(maxDepth_)) {
            tooDeep_();
        }
        return true;
    }
    bool open() {
        check();
        keys_.emplace_back();
        return true;
    }
    bool close() {
        keys_.pop_back();
        return true;
    }

    int maxDepth_;
    std::function<void()> tooDeep_;
    Repeated repeated_;
    std::vector<std::set<std::string>> keys_; ///< of the objects and arrays that are open
};

} // namespace nacre
