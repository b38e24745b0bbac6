// The page of the live view: receives messages from the bench, keeps the newest message, and shows it unless the page is paused.
"use strict";

const by_id = id => document.getElementById(id);
const model = {series: new Map(), message: null};
let paused = false, last_fifth = false, connected = false;
const charts = new Map(); // by the key of the series

const colour = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// --- numbers for people

function figure(value) {
  if (value === null || value === undefined || !isFinite(value)) return "–";
  const size = Math.abs(value);
  const digits = size >= 1000 ? 0 : size >= 100 ? 1 : size >= 10 ? 2 : 3;
  return value.toFixed(digits).replace("-", "−");
}
const percent = share => share === null ? "–" : (100 * share).toFixed(1) + " %";
const ms = us => us === null ? "–" : (us / 1000).toFixed(3);
const mark_of = outcome => outcome === "pass" ? ["✓ pass", "yes"] : outcome === "fail" ? ["✗ fail", "no"]
  : outcome === "not measured" ? ["– not measured", "unknown"] : ["open", "soft"];

// --- the document

function element(tag, style, text) {
  const one = document.createElement(tag);
  if (style) one.className = style;
  if (text !== undefined) one.textContent = text;
  return one;
}
function set_text(node, text) { if (node.textContent !== text) node.textContent = text; }

// rows: each row is an array of [text, style]; only cells that differ are changed.
function fill(table, rows) {
  const body = table.tBodies[0], labels = [...table.tHead.rows[0].cells].map(cell => cell.textContent);
  while (body.rows.length > rows.length) body.deleteRow(-1);
  rows.forEach((row, r) => {
    const line = body.rows[r] || body.insertRow();
    row.forEach(([text, style], c) => {
      const cell = line.cells[c] || line.insertCell();
      set_text(cell, text);
      cell.className = style || "";
      cell.dataset.label = labels[c];
    });
  });
}
function fill_tiles(tiles) {
  const all = by_id("tiles");
  while (all.children.length > tiles.length) all.lastChild.remove();
  tiles.forEach(([name, value, more, style], i) => {
    let tile = all.children[i];
    if (!tile) {
      tile = element("div", "tile");
      tile.append(element("small"), element("b"), element("span"));
      all.append(tile);
    }
    set_text(tile.children[0], name);
    set_text(tile.children[1], value);
    tile.children[1].className = style || "";
    set_text(tile.children[2], more);
  });
}

// --- charts

Chart.defaults.animation = false;
Chart.defaults.responsive = true;
Chart.defaults.maintainAspectRatio = false;
Chart.defaults.events = [];
Chart.defaults.font.size = 11;

function line(points, border, more) {
  return Object.assign({data: points, borderColor: border, borderWidth: 1.4, pointRadius: 0, spanGaps: false,
    fill: false, tension: 0, parsing: false, normalized: true}, more);
}

// The chart of a series key inside `parent`; it is created at first use.
function chart_of(parent, key) {
  let one = charts.get(key);
  if (one) return one;
  const box = element("figure", "chart"), caption = element("figcaption"), plot = element("div", "plot"), canvas = element("canvas");
  caption.append(element("b"), element("span"));
  canvas.setAttribute("role", "img");
  plot.append(canvas);
  box.append(caption, plot);
  by_id(parent).append(box);
  const axis = title => ({type: "linear", title: {display: true, text: title, padding: 0}, ticks: {maxTicksLimit: 6, maxRotation: 0},
    grid: {drawBorder: false}});
  const x = axis("t [s]");
  x.ticks.maxTicksLimit = 8;
  const chart = new Chart(canvas, {type: "line", data: {datasets: []},
    options: {scales: {x, y: Object.assign(axis(""), {afterFit: scale => { scale.width = 56; }})}, plugins: {legend: {display: false}, tooltip: {enabled: false}}}});
  one = {chart, box, canvas, title: caption.children[0], now: caption.children[1]};
  charts.set(key, one);
  return one;
}
function draw(one, title, unit, now, datasets, from, to) {
  set_text(one.title, title);
  set_text(one.now, now);
  one.canvas.setAttribute("aria-label", title + (unit ? " [" + unit + "]" : "") + ", now " + now);
  const {scales, plugins} = one.chart.options;
  for (const axis of [scales.x, scales.y]) {
    axis.grid.color = colour("--grid");
    axis.ticks.color = axis.title.color = colour("--soft");
  }
  scales.y.title.text = unit;
  scales.y.title.display = unit !== "";
  scales.x.min = from;
  scales.x.max = to;
  plugins.legend.labels.color = colour("--soft");
  one.chart.data.datasets = datasets;
  one.chart.update("none");
}

function draw_series(flight, from, to) {
  const shown = new Set();
  for (const {key} of flight.series) {
    const series = model.series.get(key), n = series.t_s.length;
    shown.add("series/" + key);
    const one = chart_of("series", "series/" + key);
    const points = values => series.t_s.map((x, i) => ({x, y: values[i]}));
    const datasets = [];
    if (series.kind === "error") {
      const of = sign => points(series.sigma.map(sigma => sigma === null ? null : sign * 3 * sigma));
      datasets.push(line(of(1), "transparent", {fill: "+1", backgroundColor: colour("--band")}), line(of(-1), "transparent"));
    }
    datasets.push(line(points(series.high), colour("--line"), {fill: "+1", backgroundColor: colour("--line")}),
      line(points(series.low), colour("--line")));
    const limit = (y, a, b) => line([{x: a, y}, {x: b, y}], colour("--limit"), {borderDash: [5, 4]});
    for (const bar of series.bars) datasets.push(limit(bar.below, bar.from_s, bar.to_s), limit(-bar.below, bar.from_s, bar.to_s));
    for (const y of series.between) datasets.push(limit(y, from, to));
    const sigma = n ? series.sigma[n - 1] : null, value = n ? series.high[n - 1] : null;
    draw(one, series.title, series.unit, figure(value) + (sigma === null ? "" : " ± " + figure(3 * sigma)) + " " + series.unit,
      datasets, from, to);
    one.box.dataset.quantity = series.name;
    one.box.dataset.points = n;
    one.box.dataset.last = value;
  }
  forget("series/", shown);
}
function forget(prefix, shown) {
  for (const [key, one] of charts) {
    if (!key.startsWith(prefix) || shown.has(key)) continue;
    one.chart.destroy();
    one.box.remove();
    charts.delete(key);
  }
}

function draw_timing(flight, from, to) {
  const lines = flight.timing.filter(line => line.slowest_us);
  if (lines.length === 0) return forget("timing", new Set());
  const one = chart_of("timing", "timing");
  one.chart.options.plugins.legend.display = true;
  one.chart.options.plugins.legend.align = "start";
  one.chart.options.plugins.legend.labels.boxHeight = 0;
  one.chart.options.plugins.legend.labels.boxWidth = 18;
  one.chart.options.scales.y.min = 0;
  const datasets = lines.map((timing, i) => line(
    timing.slowest_us.map((us, k) => ({x: k * timing.stretch_s, y: us === null ? null : us / 1000})).filter(point => point.y !== null),
    colour("--c" + i % 4), {label: timing.message}));
  draw(one, "slowest answer of each stretch of time", "ms", "", datasets, from, to);
  one.box.dataset.points = datasets[0].data.length;
}

function draw_load(flight, from, to) {
  const one = chart_of("load", "load");
  one.chart.options.scales.y.min = 0;
  const points = flight.load.flatMap((share, i) => [{x: i * flight.load_stretch_s, y: 100 * share},
    {x: (i + 1) * flight.load_stretch_s, y: 100 * share}]);
  draw(one, "busiest second, share of " + flight.bit_rate, "%", percent(flight.load_now),
    [line(points, colour("--line"), {fill: "origin", backgroundColor: colour("--band")})], from, to);
  one.box.dataset.points = points.length;
}

// --- the contents of a message

function show_flight(message) {
  const flight = message.flight, checks = flight.checks;
  const count = outcome => checks.filter(check => check.outcome === outcome).length;
  const failed = count("fail"), open = checks.filter(check => check.outcome === null).length;
  const closing = flight.timing.filter(line => line.slowest_us);
  const worst = (closing.length ? closing : flight.timing).reduce((a, b) => !a || b.p99_us > a.p99_us ? b : a, null);
  const faults_now = flight.faults.filter(fault => !fault.begins_in_run && flight.t_s >= fault.from_s && flight.t_s <= fault.to_s).length;
  const tiles = [
    ["Time", flight.t_s.toFixed(1) + " s", "of " + flight.duration_s + " s"],
    ["Checks", failed ? failed + " failed" : count("pass") + " passed", open ? open + " open" : "of " + checks.length, failed ? "no" : ""],
    ["Bus load", percent(flight.load_now), "busiest " + percent(flight.load_busiest)],
    ["Latency, 99 %", worst ? ms(worst.p99_us) + " ms" : "–", worst ? worst.message : flight.no_timing || "no answers yet"],
    ["Jitter, 99 %", worst && worst.jitter_count ? ms(worst.jitter_p99_us) + " ms" : "–", worst ? "max " + ms(worst.jitter_max_us) + " ms" : ""],
  ];
  if (flight.faults.length) tiles.push(["Faults", flight.outcome === null ? faults_now + " at work" : "over", "of " + flight.faults.length, faults_now && flight.outcome === null ? "unknown" : ""]);
  fill_tiles(tiles);

  const to = flight.duration_s, until = flight.outcome === null ? flight.t_s : to;
  const from = last_fifth ? Math.max(0, until - to / 5) : 0, end = last_fifth ? Math.max(until, to / 5) : to;
  by_id("series-section").hidden = flight.series.length === 0;
  draw_series(flight, from, end);

  by_id("timing-section").hidden = false;
  const why_none = flight.no_tracks || (flight.no_timing ? "not shown: " + flight.no_timing : flight.timing.length ? "" : "no answers yet");
  set_text(by_id("no-timing"), why_none);
  by_id("no-timing").hidden = why_none === "";
  by_id("timing-table").hidden = flight.timing.length === 0;
  draw_timing(flight, from, end);
  fill(by_id("timing-table"), flight.timing.map(line => [[line.message], [String(line.count)], [ms(line.p50_us)], [ms(line.p99_us)], [ms(line.max_us)],
    [line.jitter_count ? ms(line.jitter_p99_us) : "–"], [line.jitter_count ? ms(line.jitter_max_us) : "–"]]));

  by_id("checks-section").hidden = checks.length === 0;
  fill(by_id("checks"), checks.map(check => {
    const [text, style] = mark_of(check.outcome);
    return [[check.name], [text, "mark " + style], [check.measured || (check.outcome === null ? "judged when it is over" : "")]];
  }));
  by_id("load-section").hidden = flight.load.length === 0;
  if (flight.load.length) draw_load(flight, from, end);
  by_id("faults-section").hidden = flight.faults.length === 0;
  fill(by_id("faults"), flight.faults.map(fault => {
    const over = flight.outcome !== null || flight.t_s > fault.to_s, yet = flight.t_s < fault.from_s;
    if (fault.begins_in_run) return [[fault.name], [fault.stage], ["when it is told to, or by its condition"],
      flight.outcome === null ? ["the report says", "mark soft"] : ["over", "mark soft"]];
    return [[fault.name], [fault.stage], [fault.from_s + ", " + fault.to_s],
      over ? ["over", "mark soft"] : yet ? ["to come", "mark soft"] : ["at work", "mark unknown"]];
  }));
  set_text(by_id("title"), flight.title || flight.scenario);
  set_text(by_id("about"), flight.scenario + " · bus " + flight.bus + " · " + flight.clock);
  by_id("bar").style.width = 100 * (flight.outcome === null ? flight.t_s / flight.duration_s : 1) + "%";
  return [flight.outcome, flight.reason, flight.t_s > 0];
}

function show_batch(message) {
  const batch = message.batch, left = batch.total - batch.done;
  fill_tiles([
    ["Done", batch.done + " " + batch.of, "of " + batch.total],
    [batch.failed_means[0].toUpperCase() + batch.failed_means.slice(1), String(batch.failed), batch.done ? percent(batch.failed / batch.done) : "", batch.failed ? "no" : "yes"],
    ["Rate", batch.rate_per_s >= 1 ? batch.rate_per_s.toFixed(1) + " /s" : batch.rate_per_s > 0 ? (60 * batch.rate_per_s).toFixed(1) + " /min" : "–", batch.of],
    ["Left", batch.rate_per_s > 0 ? Math.ceil(left / batch.rate_per_s) + " s" : "–", left + " " + batch.of],
  ]);
  by_id("batch-section").hidden = batch.latest.length === 0;
  fill(by_id("latest"), batch.latest.map(one => [[one.name], [one.result, one.failed ? "no" : ""]]));
  set_text(by_id("title"), batch.title);
  set_text(by_id("about"), "");
  by_id("bar").style.width = (batch.total ? 100 * batch.done / batch.total : 0) + "%";
  return [batch.outcome, batch.reason, batch.done > 0];
}

function show() {
  const message = model.message;
  if (!message) return;
  let [outcome, reason, going] = message.flight ? show_flight(message) : message.batch ? show_batch(message) : [null, "", false];
  let state = going ? "running" : "waiting", style = "on";
  if (outcome) [state, style] = [outcome, outcome === "pass" ? "yes" : outcome === "fail" ? "no" : "unknown"];
  if (message.ended) [state, style, reason] = ["not flown", "no", message.ended];
  if (!message.over && !connected) [state, style] = ["no connection", "unknown"];
  if (paused) [state, style] = [state + ", paused", style];
  const pill = by_id("state");
  set_text(pill, state);
  pill.className = "pill " + style;
  by_id("reason").hidden = !reason;
  by_id("reason").className = "reason " + style;
  set_text(by_id("reason"), reason || "");
  document.title = state + " · " + by_id("title").textContent;
  set_text(by_id("feed"), message.flight ? message.frames + " frames seen, " + message.dropped + " missed by this view"
    + (message.dropped && !message.over ? ": figures are incomplete until the end" : "") : "");
  document.body.dataset.shown = message.over ? "over" : "running";
}

// --- messages

function take(message) {
  if (message.flight) {
    for (const series of message.flight.series) {
      let known = model.series.get(series.key);
      if (!known || series.from === 0) {
        model.series.set(series.key, series);
        continue;
      }
      for (const list of ["t_s", "low", "high", "sigma"]) known[list].splice(series.from, Infinity, ...series[list]);
      known.bars = series.bars;
    }
  }
  model.message = message;
  document.body.dataset.received = Number(document.body.dataset.received || 0) + 1;
  if (!paused) show();
}

function connect() {
  const socket = new WebSocket("ws://" + location.host + "/live" + location.search);
  socket.onopen = () => { connected = true; };
  socket.onmessage = event => take(JSON.parse(event.data));
  socket.onclose = () => {
    connected = false;
    if (model.message && !paused) show();
    if (!model.message) { set_text(by_id("state"), "no connection"); }
    setTimeout(connect, 2000); // the next run may use the same port
  };
}

// --- keys

function pause() {
  paused = !paused;
  by_id("pause").setAttribute("aria-pressed", String(paused));
  set_text(by_id("pause"), paused ? "Go on" : "Pause");
  show();
}
function change_range() {
  last_fifth = !last_fifth;
  by_id("range").setAttribute("aria-pressed", String(last_fifth));
  show();
}
for (const [id, action] of [["pause", pause], ["range", change_range]])
  by_id(id).onclick = event => {
    action();
    if (event.detail > 0) event.target.blur(); // after a mouse click, key presses go to the page again
  };
document.addEventListener("keydown", event => {
  if (event.ctrlKey || event.altKey || event.metaKey || event.repeat || event.target instanceof HTMLButtonElement) return;
  if (event.key === " ") { event.preventDefault(); pause(); }
  if (event.key === "w") change_range();
});
matchMedia("(prefers-color-scheme:dark)").addEventListener("change", show);
connect();
