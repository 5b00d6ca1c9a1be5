// The contact sheet of a cohort: filters, order, rating by keys, and the ratings as a table. It asks no server for anything.

const list = document.querySelector('ol');
const tiles = [...list.children];
const shown = document.querySelector('#shown');
const place = `lumencut ratings ${list.dataset.cohort}`;
const kinds = { g: 'good', r: 'redo', x: 'exclude', u: '' };
const tests = {
  all: () => true,
  failed: (tile) => tile.dataset.state === 'failed',
  flagged: (tile) => Number(tile.dataset.flags) > 0,
  doubtful: (tile) => Number(tile.dataset.doubtful) > 0,
  unrated: (tile) => !tile.dataset.rating,
  good: (tile) => tile.dataset.rating === 'good',
  redo: (tile) => tile.dataset.rating === 'redo',
  exclude: (tile) => tile.dataset.rating === 'exclude',
};

/** Ratings are kept in the browser, so that closing the page loses none. Some browsers keep nothing for files. */
function kept() {
  try {
    return JSON.parse(localStorage.getItem(place) ?? '{}');
  } catch {
    return {};
  }
}
const ratings = kept();

/** So many tiles are shown at once, and as many more where the page is scrolled to its end. */
const AT_ONCE = 200;
let most = AT_ONCE;
let hasMore = false;

const end = document.querySelector('footer');
const observer = new IntersectionObserver(
  (entries) => entries.some((entry) => entry.isIntersecting) && showMore(),
  { rootMargin: '800px' },
);

function show(tile) {
  const rating = ratings[tile.dataset.id] ?? '';
  tile.dataset.rating = rating;
  tile.querySelector('.rating').textContent = rating;
}

function rate(tile, rating) {
  if (rating) ratings[tile.dataset.id] = rating;
  else delete ratings[tile.dataset.id];
  show(tile);
  try {
    localStorage.setItem(place, JSON.stringify(ratings));
  } catch {
    // They are still on the page, and can be saved as a table.
  }
}

/** Shows the tiles that fit, in their order, as far as they go: a browser is slow with thousands at once. */
function apply() {
  const test = tests[document.querySelector('#filter').value];
  const words = document.querySelector('#search').value.toLowerCase();
  let count = 0;
  for (const tile of list.children) {
    const fits = test(tile) && tile.dataset.id.toLowerCase().includes(words);
    count += fits ? 1 : 0;
    tile.classList.toggle('hidden', !fits || count > most);
  }
  hasMore = count > most;
  shown.textContent = `${count} of ${tiles.length} studies`;
}

function filter() {
  most = AT_ONCE;
  apply();
}

function showMore() {
  if (!hasMore) return;
  most += AT_ONCE;
  apply();
  // It tells of changes alone, and the end of the page may still be near.
  observer.unobserve(end);
  observer.observe(end);
}

/** What cannot be compared comes last. */
function order() {
  const key = document.querySelector('#order').value;
  const number = (tile) => (tile.dataset[key] === '' ? Infinity : Number(tile.dataset[key]));
  const falls = key === 'flags' || key === 'doubtful' || key === 'seconds';
  const sorted = [...tiles].sort((a, b) => {
    if (key === 'id') return a.dataset.id.localeCompare(b.dataset.id, undefined, { numeric: true });
    const [first, second] = [number(a), number(b)];
    if (first === second) return Number(a.dataset.row) - Number(b.dataset.row);
    if (!Number.isFinite(first) || !Number.isFinite(second)) return first - second;
    return falls ? second - first : first - second;
  });
  list.append(...sorted);
  filter();
}

/** The next tile that is shown, in a direction. */
function neighbour(tile, direction) {
  if (direction === 'nextElementSibling' && tile.nextElementSibling?.classList.contains('hidden')) showMore();
  let next = tile;
  do next = next?.[direction];
  while (next?.classList.contains('hidden'));
  return next;
}

function press(event) {
  const tile = event.target.closest?.('li');
  if (!tile || event.ctrlKey || event.metaKey || event.altKey) return;
  const direction = { ArrowRight: 'nextElementSibling', ArrowLeft: 'previousElementSibling' }[event.key];
  if (event.key === 'Enter') {
    openPicture(tile);
    event.preventDefault();
  } else if (direction) {
    neighbour(tile, direction)?.focus();
    event.preventDefault();
  } else if (event.key in kinds) {
    rate(tile, kinds[event.key]);
    neighbour(tile, 'nextElementSibling')?.focus();
  }
}

/** The picture of a tile, in a tab of its own; a study that failed has none. */
function openPicture(tile) {
  const picture = tile.querySelector('a[href]');
  if (picture) window.open(picture.href, '_blank', 'noopener');
}

/** A click selects a tile; with a key held it is left to the browser, which opens links in its own ways. */
function select(event) {
  if (event.ctrlKey || event.metaKey || event.shiftKey) return;
  event.preventDefault();
  event.target.closest('li')?.focus();
}

/** An id as a cell of CSV, by the rule of the other tables: behind an apostrophe where a spreadsheet would run it. */
function cell(id) {
  const isNumber = /^[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?$/.test(id);
  const marked = /^'*[=+\-@\t\r]/.test(id) && !isNumber ? `'${id}` : id;
  return /[",\n\r]/.test(marked) ? `"${marked.replaceAll('"', '""')}"` : marked;
}

function save() {
  const rows = tiles
    .filter((tile) => tile.dataset.rating)
    .map((tile) => `${cell(tile.dataset.id)},${tile.dataset.rating}\n`);
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob(['id,rating\n', ...rows], { type: 'text/csv' }));
  link.download = 'ratings.csv';
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

tiles.forEach(show);
filter();
document.querySelector('#filter').addEventListener('change', filter);
document.querySelector('#search').addEventListener('input', filter);
document.querySelector('#order').addEventListener('change', order);
document.querySelector('#save').addEventListener('click', save);
list.addEventListener('keydown', press);
list.addEventListener('click', select);
list.addEventListener('dblclick', (event) => {
  const tile = event.target.closest('li');
  if (tile) openPicture(tile);
});
observer.observe(end);
