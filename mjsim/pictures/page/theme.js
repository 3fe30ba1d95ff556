const dark = matchMedia("(prefers-color-scheme: dark)");
function paint() {
  const ink = matchMedia("print").matches || !dark.matches ? "#333" : "#ccc";
  for (const chart of document.querySelectorAll(".js-plotly-plot")) {
    Plotly.relayout(chart, { "font.color": ink });
  }
}
addEventListener("load", paint);
dark.addEventListener("change", paint);
