#include "view/window/timing_panel.hpp"

#include <QPainter>
#include <QVBoxLayout>

#include <algorithm>
#include <numeric>
#include <string_view>

namespace nacre::view {
namespace {

constexpr std::size_t mostFrames = 240;
constexpr int tableMilliseconds = 500; // that a table can be read
constexpr double mebibyte = 1024.0 * 1024.0;

struct PartRow {
    const char* name;
    QColor color;
};
constexpr std::array<PartRow, TimingGraph::PartCount> parts{
    PartRow{"shadow maps", QColor(110, 110, 120)}, PartRow{"G-buffer", QColor(90, 130, 170)},
    PartRow{"lighting", QColor(200, 170, 80)},     PartRow{"scatter", QColor(210, 90, 80)},
    PartRow{"transmit", QColor(230, 140, 90)},     PartRow{"compose", QColor(110, 160, 110)}};

TimingGraph::Part partOf(std::string_view pass) {
    struct Row {
        std::string_view begin;
        TimingGraph::Part part;
    };
    constexpr std::array rows{Row{"shadow", TimingGraph::ShadowMaps}, Row{"G-buffer", TimingGraph::Geometry},
                              Row{"ambient", TimingGraph::Lighting},  Row{"lighting", TimingGraph::Lighting},
                              Row{"scatter", TimingGraph::Scatter},   Row{"transmit", TimingGraph::Transmit}};
    const auto row = std::ranges::find_if(rows, [&](const Row& each) { return pass.starts_with(each.begin); });
    return row == rows.end() ? TimingGraph::Compose : row->part;
}

} // namespace

TimingGraph::TimingGraph(QWidget* parent) : QWidget(parent) {
    setObjectName("timing.graph");
    setAccessibleName("Times of the last frames");
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

const char* TimingGraph::nameOf(Part part) {
    return parts[part].name;
}

void TimingGraph::add(const renderer::FrameReport& report) {
    Times times{};
    for (const renderer::PassTime& pass : report.passes) {
        times[partOf(pass.name)] += pass.microseconds / 1e3;
    }
    history_.push_back(times);
    if (history_.size() > mostFrames) {
        history_.pop_front();
    }
    update();
}

void TimingGraph::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const QFontMetrics metrics = painter.fontMetrics();
    const int row = metrics.height();
    const int legend = metrics.horizontalAdvance("shadow maps 00000.00") + 20;
    const QRect area(0, 0, width() - legend - 6, height() - 1);
    painter.fillRect(area, palette().color(QPalette::Base));
    if (history_.empty()) {
        return;
    }
    // The slowest frames, as the first with its shadow maps, may stand out of the top.
    std::vector<double> totals;
    for (const Times& times : history_) {
        totals.push_back(std::accumulate(times.begin(), times.end(), 0.0));
    }
    std::ranges::sort(totals);
    const double top = std::max(1e-3, 1.25 * totals[totals.size() * 9 / 10]);
    const double barWidth = double(area.width()) / mostFrames;
    for (std::size_t i = 0; i < history_.size(); ++i) {
        double below = 0;
        const double x = area.right() - barWidth * double(history_.size() - i);
        for (std::size_t part = 0; part < PartCount; ++part) {
            const double y = area.bottom() - (below + history_[i][part]) / top * area.height();
            painter.fillRect(QRectF(x, y, barWidth, history_[i][part] / top * area.height()) & QRectF(area),
                             parts[part].color);
            below += history_[i][part];
        }
    }
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(area.adjusted(4, 2, 0, 0), Qt::AlignTop | Qt::AlignLeft, QString("%1 ms").arg(top, 0, 'g', 3));
    for (std::size_t part = 0; part < PartCount; ++part) {
        const int y = static_cast<int>(PartCount - 1 - part) * (row + 3);
        painter.fillRect(QRect(area.right() + 6, y + 3, 10, row - 6), parts[part].color);
        painter.drawText(QRect(area.right() + 20, y, legend - 14, row), Qt::AlignLeft | Qt::AlignVCenter,
                         QString("%1 %2").arg(parts[part].name).arg(history_.back()[part], 0, 'f', 2));
    }
}

TimingPanel::TimingPanel(QWidget* parent)
    : QWidget(parent), graph_(new TimingGraph), text_(new QLabel), tables_(new QLabel) {
    text_->setObjectName("timing.text");
    text_->setWordWrap(true);
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(graph_);
    layout->addWidget(text_);
    tables_->setObjectName("timing.tables");
    layout->addWidget(tables_);
    layout->addStretch();
}

void TimingPanel::add(const renderer::FrameReport& report, double processorMilliseconds) {
    graph_->add(report);
    const std::uint64_t bytes =
        std::accumulate(report.memory.begin(), report.memory.end(), std::uint64_t{0},
                        [](std::uint64_t sum, const renderer::MemoryUse& use) { return sum + use.bytes; });
    text_->setText(
        QString("Device %1 ms a frame, processor %2 ms. Device memory of a frame %3 MiB, of that the effect's "
                "intermediates %4 MiB. %5 % of the pixels have a subsurface material.")
            .arg(report.totalMicroseconds / 1e3, 0, 'f', 2)
            .arg(processorMilliseconds, 0, 'f', 2)
            .arg(double(bytes) / mebibyte, 0, 'f', 0)
            .arg(double(report.effectBytes) / mebibyte, 0, 'f', 1)
            .arg(100 * report.subsurfaceCoverage, 0, 'f', 0));
    if (!isVisible() || (tablesAge_.isValid() && !tablesAge_.hasExpired(tableMilliseconds))) {
        return;
    }
    tablesAge_.start();
    QString rows;
    const auto row = [&rows](const std::string& name, const QString& value) {
        rows += QString("<tr><td>%1&nbsp;&nbsp;</td><td align=right>%2</td></tr>")
                    .arg(QString::fromStdString(name).toHtmlEscaped(), value);
    };
    rows += "<tr><th align=left>pass</th><th align=right>ms</th></tr>";
    for (const renderer::PassTime& pass : report.passes) {
        row(pass.name, QString::number(pass.microseconds / 1e3, 'f', 3));
    }
    rows += "<tr><th align=left>memory</th><th align=right>MiB</th></tr>";
    for (const renderer::MemoryUse& use : report.memory) {
        row(use.name, QString::number(double(use.bytes) / mebibyte, 'f', 1));
    }
    tables_->setText("<table>" + rows + "</table>");
}

} // namespace nacre::view
