// A picture of the view, and what is drawn over it.

const TITLES = {
  vessels: 'Vessels: drag to turn, wheel to zoom, click for the cross-hair',
  straightened: 'The picked vessel straightened: the wheel turns it',
  section: 'The section across the picked vessel: the wheel moves it along',
};

/** A picture with what is drawn over it. */
class Pane {
  constructor(name, parent) {
    this.name = name;
    this.element = parent.appendChild(document.createElement('div'));
    this.element.className = 'pane';
    this.element.dataset.pane = name;
    this.element.tabIndex = 0;
    this.element.title = TITLES[name];
    this.element.setAttribute('role', 'img');
    this.element.setAttribute('aria-label', TITLES[name]);
    this.element.hidden = name !== 'vessels';
    this.canvas = this.element.appendChild(document.createElement('canvas'));
    this.svg = this.element.appendChild(document.createElementNS('http://www.w3.org/2000/svg', 'svg'));
    this.size = null;
    this.latest = 0;
  }

  /** Shows a picture; of several that are decoded at a time the last one stays. */
  async draw(bytes, type) {
    this.latest += 1;
    const number = this.latest;
    this.element.hidden = bytes.byteLength === 0;
    if (bytes.byteLength === 0) {
      return;
    }
    const picture = await createImageBitmap(new Blob([bytes], { type }));
    if (number === this.latest) {
      [this.canvas.width, this.canvas.height] = [picture.width, picture.height];
      this.canvas.getContext('2d').drawImage(picture, 0, 0);
      this.resize(this.name === 'vessels' ? this.size : [picture.width, picture.height]);
    }
    picture.close();
  }

  resize(size) {
    this.size = size ?? [this.canvas.width, this.canvas.height];
    this.element.style.width = `${this.size[0]}px`;
    this.element.style.aspectRatio = `${this.size[0]} / ${this.size[1]}`;
    this.svg.setAttribute('viewBox', `-0.5 -0.5 ${this.size[0]} ${this.size[1]}`);
  }

  /** Column and row of a place on the screen, from the top left; (0, 0) is the middle of the first pixel. */
  pixelOf([x, y]) {
    const box = this.element.getBoundingClientRect();
    const [width, height] = this.size;
    return [(x / box.width) * width - 0.5, (y / box.height) * height - 0.5];
  }

  /** How many pixels of the picture one of the screen is. */
  get scale() {
    return this.size[0] / Math.max(this.element.getBoundingClientRect().width, 1);
  }

  /** Draws cross-hairs, points and lines at columns and rows. */
  mark(crosses, points, lines) {
    const path = (at) => `M${at.map(([x, y]) => `${x},${y}`).join('L')}`;
    const cross = ([x, y]) =>
      `M${x - 9},${y}H${x - 3}M${x + 3},${y}H${x + 9}M${x},${y - 9}V${y - 3}M${x},${y + 3}V${y + 9}`;
    const drawn = [...lines.map(path), ...crosses.map(cross)].map((d) => shape('path', { d }));
    this.svg.replaceChildren(...drawn, ...points.map(([cx, cy]) => shape('circle', { cx, cy, r: 3 })));
  }
}

function shape(name, attributes) {
  const made = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) {
    made.setAttribute(key, value);
  }
  return made;
}
