#include "app/rgb_table.hpp"

#include <iomanip>
#include <sstream>

namespace nacre::app {

std::string rgbHeader() {
    std::ostringstream text;
    text << "  " << std::setw(34) << "" << std::setw(11) << "red" << std::setw(11) << "green" << std::setw(11) << "blue"
         << '\n';
    return text.str();
}

std::string rgbRow(const std::string& label, const Rgb& values) {
    std::ostringstream text;
    text << "  " << std::left << std::setw(34) << label << std::right << std::setprecision(4);
    for (const double value : values) {
        text << std::setw(11) << value;
    }
    return text.str() + '\n';
}

} // namespace nacre::app
