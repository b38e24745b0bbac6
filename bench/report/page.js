// Makes the plots of a page interactive: a cursor with the values of all curves, zoom, curves on and off. The
// curves of a plot (line_plot.cpp) are paths in the units of their values, in an inner svg element whose viewBox is the
// range of the axes. So the paths are the data, and zooming is another viewBox.
"use strict";
(() => {
  const least_share = 1 / 500; // of an axis that zooming may leave
  const click_px = 5;          // a pointer that moves less does not drag

  function element(parent, name, attributes = {}, text = "") {
    const namespace = parent instanceof SVGElement ? "http://www.w3.org/2000/svg" : "http://www.w3.org/1999/xhtml";
    const one = parent.appendChild(document.createElementNS(namespace, name));
    for (const [key, value] of Object.entries(attributes)) one.setAttribute(key, value);
    one.textContent = text;
    return one;
  }

  // As round_values() and mark_labels() of plot.cpp.
  function round_values(from, to, most) {
    const rough = (to - from) / most, power = 10 ** Math.floor(Math.log10(rough));
    const step = ([1, 2, 5].find(times => times * power >= rough) ?? 10) * power, values = [];
    for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9 * step; ++i) values.push(i * step);
    return values;
  }
  function mark_labels(values) {
    const step = values.length > 1 ? values[1] - values[0] : Math.abs(values[0]);
    const largest = Math.max(Math.abs(values[0]), Math.abs(values.at(-1)), step);
    const lowest = Math.floor(Math.log10(step) + 1e-9), highest = Math.floor(Math.log10(largest) + 1e-9);
    const is_plain = largest < 1e6 && largest >= 1e-4;
    const digits = Math.min(Math.max(0, is_plain ? -lowest : highest - lowest), 20);
    return values.map(value => value === 0 ? "0" : is_plain ? value.toFixed(digits) : value.toExponential(digits));
  }
  const words = value => Number(value.toPrecision(5)).toString();

  // The stretches of a path, each as its points [t, value].
  const stretches_of = path => path.getAttribute("d").split("M").slice(1).map(
    stretch => stretch.replace("Z", "").split("L").map(point => point.split(" ").map(Number)));

  class Curve {
    constructor(path, name, base) {
      this.path = path;
      this.name = name;
      const kind = path.dataset.kind;
      this.both = kind === "both";
      // {t, low, high} for each point, in order of time; the stretches for -value of `both` are left out.
      this.points = [];
      this.ends = []; // the last time of each stretch
      let stretches = stretches_of(path);
      if (this.both) stretches = stretches.slice(0, stretches.length / 2);
      for (const points of stretches) {
        const is_area = kind === "area" || kind === "top", size = is_area ? points.length / 2 : points.length;
        for (let i = 0; i < size; ++i) {
          const high = points[i][1] + base, low = is_area ? points[points.length - 1 - i][1] + base : high;
          this.points.push({t: points[i][0], low: kind === "top" ? high : low, high, ends: i === size - 1});
        }
      }
    }
    is_shown() { return this.path.getAttribute("display") !== "none"; }
    // The point at or before a time; undefined: none, as at a gap.
    at(t) {
      let low = 0, high = this.points.length;
      while (low < high) {
        const middle = (low + high) >> 1;
        if (this.points[middle].t <= t) low = middle + 1;
        else high = middle;
      }
      const point = this.points[low - 1];
      return point && (!point.ends || low === this.points.length || point.t === t) ? point : undefined;
    }
    text_at(t) {
      const point = this.at(t);
      if (!point) return "–";
      return point.low === point.high ? words(point.high) : `${words(point.low)} to ${words(point.high)}`;
    }
  }

  class Plot {
    constructor(svg) {
      this.svg = svg;
      this.inner = svg.querySelector("svg");
      this.marks = svg.querySelector(".marks");
      this.legend = svg.parentNode.querySelector(".legend");
      const [x, y, width, height] = ["x", "y", "width", "height"].map(name => Number(this.inner.getAttribute(name)));
      this.box = {x, y, width, height};
      this.base = Number(this.inner.dataset.base);
      this.home = this.range = this.range_of(this.inner);
      this.names = new Map([...this.legend.children].map(one => [one.dataset.curve, one.textContent.trim()]));
      this.curves = [...this.inner.querySelectorAll("[data-kind]")].map(
        path => new Curve(path, this.names.get(path.dataset.curve), this.base));
      this.times = [...new Set(this.curves.flatMap(curve => curve.points.map(point => point.t)))].sort((a, b) => a - b);
      this.line = element(svg, "path", {class: "cursor", d: ""});
      this.frame = element(svg, "rect", {class: "selection", display: "none"});
      this.readout = document.createElement("div");
      this.readout.className = "readout";
      this.readout.setAttribute("role", "status");
      this.readout.hidden = true;
      svg.before(this.readout);
      this.make_legend();
      this.listen();
    }
    range_of(inner) {
      const [x, y, width, height] = inner.getAttribute("viewBox").split(" ").map(Number);
      return {from: x, to: x + width, low: this.base - y - height, high: this.base - y};
    }

    // --- places and values; `place` has the coordinates of the outer svg element
    place_of(event) { return new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse()); }
    t_at(x) { return this.range.from + (x - this.box.x) / this.box.width * (this.range.to - this.range.from); }
    value_at(y) { return this.range.high - (y - this.box.y) / this.box.height * (this.range.high - this.range.low); }
    x_of(t) { return this.box.x + (t - this.range.from) / (this.range.to - this.range.from) * this.box.width; }
    y_of(value) { return this.box.y + (this.range.high - value) / (this.range.high - this.range.low) * this.box.height; }
    is_inside(place) {
      return place.x >= this.box.x && place.x <= this.box.x + this.box.width && place.y >= this.box.y && place.y <= this.box.y + this.box.height;
    }

    // --- zoom
    zoom(range) {
      const {from, to, low, high} = range, home = this.home;
      if (to - from < (home.to - home.from) * least_share || high - low < (home.high - home.low) * least_share) return;
      this.range = range;
      this.inner.setAttribute("viewBox", [from, this.base - high, to - from, high - low].join(" "));
      const paths = this.marks.querySelectorAll("path");
      this.marks.querySelectorAll("text").forEach(text => text.remove());
      const rows = round_values(low, high, 5), columns = round_values(from, to, 6);
      const {x, y, width, height} = this.box, row_labels = mark_labels(rows), column_labels = mark_labels(columns);
      const rules = zero => rows.filter(value => (value === 0) === zero).map(value => `M${x} ${this.y_of(value)}h${width}`).join("");
      paths[0].setAttribute("d", rules(false));
      paths[1].setAttribute("d", rules(true));
      paths[2].setAttribute("d", columns.map(t => `M${this.x_of(t)} ${y + height}v5`).join(""));
      rows.forEach((value, i) => element(this.marks, "text", {x: x - 6, y: this.y_of(value) + 4, "text-anchor": "end"}, row_labels[i]));
      columns.forEach((t, i) => element(this.marks, "text", {x: this.x_of(t), y: y + height + 19, "text-anchor": "middle"}, column_labels[i]));
      for (const ring of this.svg.querySelectorAll("circle")) {
        const place = {x: this.x_of(Number(ring.dataset.t)), y: this.y_of(Number(ring.dataset.value) + this.base)};
        ring.setAttribute("cx", place.x);
        ring.setAttribute("cy", place.y);
        ring.setAttribute("visibility", this.is_inside(place) ? "visible" : "hidden");
      }
      this.whole.hidden = range === home;
      if (this.cursor_t !== undefined) this.show_cursor(this.cursor_t);
    }
    // A lower `share` shows less; `t` stays where it is.
    zoom_about(t, share) {
      const {from, to} = this.range, home = this.home;
      const range = {from: Math.max(home.from, t - (t - from) * share), to: Math.min(home.to, t + (to - t) * share)};
      if (range.from === home.from && range.to === home.to) this.zoom(home);
      else this.zoom_to_times(range);
    }
    // Shows a stretch of time; the other axis fits the shown curves in it.
    zoom_to_times({from, to}) {
      let low = Infinity, high = -Infinity;
      for (const curve of this.curves.filter(one => one.is_shown())) {
        for (const point of [curve.at(from), ...curve.points.filter(one => one.t >= from && one.t <= to)]) {
          if (!point) continue;
          low = Math.min(low, curve.both ? -point.high : point.low);
          high = Math.max(high, point.high);
        }
      }
      if (this.home.low === 0) low = 0;
      const margin = 0.05 * (high - low);
      if (high > low) this.zoom({from, to, low: this.home.low === 0 ? 0 : low - margin, high: high + margin});
      else this.zoom({...this.range, from, to});
    }
    zoom_to_box(a, b) {
      const [from, to] = [a.x, b.x].sort((one, other) => one - other).map(x => Math.min(Math.max(this.t_at(x), this.range.from), this.range.to));
      const [high, low] = [a.y, b.y].sort((one, other) => one - other).map(y => Math.min(Math.max(this.value_at(y), this.range.low), this.range.high));
      const is_flat = Math.abs(a.y - b.y) < this.box.height / 6; // only a stretch of time is meant
      if (is_flat) this.zoom_to_times({from, to});
      else this.zoom({from, to, low, high});
    }

    // --- cursor
    show_cursor(t) {
      if (this.times.length === 0) return;
      const after = this.times.findIndex(one => one > t);
      this.index = Math.max(0, (after < 0 ? this.times.length : after) - 1);
      this.cursor_t = t = this.times[this.index];
      const x = Math.min(Math.max(this.x_of(t), this.box.x), this.box.x + this.box.width);
      this.line.setAttribute("d", `M${x} ${this.box.y}v${this.box.height}`);
      const list = this.curves.filter(curve => curve.is_shown()).map(curve => `${curve.name}: ${curve.text_at(t)}`);
      this.readout.textContent = "";
      element(this.readout, "b", {}, `${words(t)} ${this.unit_of(1)}`);
      for (const one of list) element(this.readout, "div", {}, `${one} ${this.unit_of(0)}`);
      this.readout.hidden = false;
      this.readout.classList.toggle("right", x < this.box.x + this.box.width / 2);
    }
    // The texts of the outer svg element that are no marks: the units of the horizontal (1) and the vertical axis (0).
    unit_of(horizontal) { return [...this.svg.querySelectorAll(":scope > text")].at(horizontal ? 0 : 1)?.textContent ?? ""; }
    hide_cursor() {
      this.cursor_t = undefined;
      this.line.setAttribute("d", "");
      this.readout.hidden = true;
    }
    step(points) { this.show_cursor(this.times[Math.min(Math.max((this.cursor_t === undefined ? -1 : this.index) + points, 0), this.times.length - 1)]); }

    // --- legend
    make_legend() {
      const entries = [...this.legend.children];
      this.legend.textContent = "";
      for (const entry of entries) {
        const button = element(this.legend, "button", {type: "button", "data-curve": entry.dataset.curve, "aria-pressed": true});
        button.append(...entry.childNodes);
        button.addEventListener("click", () => this.toggle(button));
      }
      this.whole = element(this.legend, "button", {type: "button", class: "whole"}, "show all");
      this.whole.hidden = true;
      this.whole.addEventListener("click", () => this.zoom(this.home));
    }
    toggle(button) {
      const shown = button.getAttribute("aria-pressed") !== "true";
      button.setAttribute("aria-pressed", shown);
      for (const one of this.svg.querySelectorAll(`[data-curve="${button.dataset.curve}"]`)) {
        if (shown) one.removeAttribute("display");
        else one.setAttribute("display", "none");
      }
      if (this.cursor_t !== undefined) this.show_cursor(this.cursor_t);
    }

    // --- pointer and keys
    listen() {
      const {svg} = this;
      let start = null, dragging = false;
      const end = () => {
        start = null;
        dragging = false;
        this.frame.setAttribute("display", "none");
      };
      svg.addEventListener("pointerdown", event => {
        if (event.button !== 0 || !this.is_inside(this.place_of(event))) return;
        start = {place: this.place_of(event), x: event.clientX, y: event.clientY};
        svg.setPointerCapture(event.pointerId);
      });
      svg.addEventListener("pointermove", event => {
        const place = this.place_of(event);
        dragging ||= start !== null && Math.hypot(event.clientX - start.x, event.clientY - start.y) > click_px;
        if (!dragging) return this.is_inside(place) ? this.show_cursor(this.t_at(place.x)) : this.hide_cursor();
        const [from, to] = [start.place, place], is_flat = Math.abs(from.y - to.y) < this.box.height / 6;
        const frame = {display: "inline", x: Math.min(from.x, to.x), width: Math.abs(from.x - to.x),
                       y: is_flat ? this.box.y : Math.min(from.y, to.y), height: is_flat ? this.box.height : Math.abs(from.y - to.y)};
        for (const [key, value] of Object.entries(frame)) this.frame.setAttribute(key, value);
      });
      svg.addEventListener("pointerup", event => {
        const place = this.place_of(event);
        if (dragging) this.zoom_to_box(start.place, place);
        else if (this.is_inside(place)) this.show_cursor(this.t_at(place.x));
        end();
      });
      svg.addEventListener("pointercancel", end);
      svg.addEventListener("pointerleave", event => { if (event.pointerType === "mouse" && !start) this.hide_cursor(); });
      svg.addEventListener("dblclick", () => this.zoom(this.home));
      svg.addEventListener("wheel", event => { // without Ctrl, the wheel scrolls the page
        if (!event.ctrlKey || !this.is_inside(this.place_of(event))) return;
        event.preventDefault();
        this.zoom_about(this.t_at(this.place_of(event).x), 2 ** (event.deltaY / 200));
      }, {passive: false});
      svg.setAttribute("tabindex", "0");
      svg.addEventListener("blur", () => this.hide_cursor());
      svg.addEventListener("keydown", event => {
        const middle = this.cursor_t ?? (this.range.from + this.range.to) / 2, points = event.shiftKey ? 10 : 1;
        const action = {ArrowLeft: () => this.step(-points), ArrowRight: () => this.step(points), "+": () => this.zoom_about(middle, 0.5),
                        "-": () => this.zoom_about(middle, 2), "0": () => this.zoom(this.home), Escape: () => this.hide_cursor()}[event.key];
        if (!action || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        action();
      });
    }
  }

  const plots = [...document.querySelectorAll("svg.lines")].map(svg => new Plot(svg));
  document.documentElement.dataset.plots = plots.length; // the page is ready
})();
