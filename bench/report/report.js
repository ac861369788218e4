"use strict";
// Draws the plots of a benchmark report with Chart.js and moves its picture sliders.
(function () {
  // Okabe and Ito's palette, told apart with any colour vision; the points' shapes do it in grey.
  const colors = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#7a5195", "#000000"];
  const shapes = ["circle", "rect", "triangle", "rectRot", "rectRounded", "crossRot", "star", "cross"];
  const looks = {
    floor: { borderColor: "#777777", borderDash: [3, 3], pointRadius: 0, pointStyle: "line" },
    thesis: { borderColor: "#000000", borderDash: [8, 4], pointRadius: 0, pointStyle: "line" },
    frontier: { borderColor: "#777777", borderDash: [2, 3], pointRadius: 0, pointStyle: "line",
                stepped: "before" },
  };

  const whiskers = {
    id: "whiskers",
    afterDatasetsDraw(chart) {
      const context = chart.ctx;
      chart.data.datasets.forEach((set, index) => {
        if (!chart.isDatasetVisible(index)) return;
        context.save();
        const area = chart.chartArea;
        const inside = (y) => Math.min(Math.max(y, area.top), area.bottom);
        context.strokeStyle = context.fillStyle = set.borderColor;
        context.lineWidth = 1.2;
        context.font = "11px sans-serif";
        set.data.forEach((point) => {
          const x = chart.scales.x.getPixelForValue(point.x);
          const y = chart.scales.y.getPixelForValue(point.y);
          if (point.high > point.low) {
            const low = inside(chart.scales.y.getPixelForValue(point.low));
            const high = inside(chart.scales.y.getPixelForValue(point.high));
            context.beginPath();
            context.moveTo(x, low); context.lineTo(x, high);
            context.moveTo(x - 4, low); context.lineTo(x + 4, low);
            context.moveTo(x - 4, high); context.lineTo(x + 4, high);
            context.stroke();
          }
          if (point.label) {
            const rightmost = chart.width - context.measureText(point.label).width;
            context.fillText(point.label, Math.min(x + 7, rightmost), y - 5);
          }
        });
        context.restore();
      });
    },
  };

  function dataset(set) {
    const color = colors[set.color % colors.length];
    const look = looks[set.kind] || {
      borderColor: color, backgroundColor: color, pointStyle: shapes[set.color % shapes.length], pointRadius: 4,
      pointBorderColor: color, pointBorderWidth: 2, clip: 8,
    };
    return Object.assign({ label: set.name, data: set.points, showLine: set.joined, borderWidth: 1.8, tension: 0 }, look);
  }

  function axis(title, logarithmic) {
    return {
      type: logarithmic ? "logarithmic" : "linear",
      beginAtZero: !logarithmic && title.startsWith("time"),
      grace: title.startsWith("PSNR") ? "8%" : undefined,
      title: { display: true, text: title, color: "#1a1a1a" },
      ticks: { color: "#1a1a1a", callback: logarithmic ? decades : undefined, maxRotation: 0 },
      grid: { color: "#e6e6e6" },
    };
  }

  // Logarithmic axes would label every line; 1, 2 and 5 are enough.
  function decades(value) {
    const digit = Number(value.toExponential()[0]);
    return [1, 2, 5].includes(digit) ? value.toLocaleString("en") : "";
  }

  // Whiskers fit in unless they are out of all proportion.
  function roomForWhiskers(chart) {
    const points = chart.sets.flatMap((set) => set.points);
    const largest = Math.max(...points.map((point) => point.y));
    return Math.min(Math.max(...points.map((point) => point.high)), 1.5 * largest);
  }

  function draw(canvas, chart) {
    const options = {
      animation: false, maintainAspectRatio: false, devicePixelRatio: Math.max(2, window.devicePixelRatio || 1),
      scales: { x: axis(chart.xLabel, chart.logX),
                y: Object.assign(axis(chart.yLabel, chart.logY), { suggestedMax: roomForWhiskers(chart) }) },
      plugins: {
        legend: { position: "bottom", labels: { usePointStyle: true, boxWidth: 9, boxHeight: 7, color: "#1a1a1a", padding: 12 } },
      },
    };
    return new Chart(canvas, { type: "scatter", data: { datasets: chart.sets.map(dataset) }, options, plugins: [whiskers] });
  }

  const data = JSON.parse(document.getElementById("charts").textContent);
  const drawn = Array.from(document.querySelectorAll("canvas[data-chart]"),
                           (canvas) => draw(canvas, data[Number(canvas.dataset.chart)]));

  // "report.html#plot-2" is that plot alone, for documents that show it as a picture.
  const alone = document.querySelector(`canvas[data-chart="${location.hash.replace(/^#plot-/, "")}"]`);
  if (location.hash.startsWith("#plot-") && alone) {
    const figure = alone.closest("figure");
    figure.querySelector("h3").textContent = alone.getAttribute("aria-label");
    document.body.replaceChildren(figure);
    document.body.classList.add("alone");
  }

  document.querySelectorAll(".pair").forEach((pair) => {
    const slider = pair.querySelector("input");
    const move = () => pair.style.setProperty("--split", slider.value + "%");
    slider.addEventListener("input", move);
    move();
  });

  const pictures = Array.from(document.images).filter((image) => image.complete && image.naturalWidth > 0);
  document.documentElement.dataset.pictures = String(pictures.length);
  const cut = Array.from(document.querySelectorAll(".scroll"))
    .filter((table) => !table.closest("details") && table.scrollWidth > table.clientWidth);
  document.documentElement.dataset.cutTables = String(cut.length);
  document.documentElement.dataset.drawn = String(drawn.length);
})();
