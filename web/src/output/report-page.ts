/** The report of one vessel as a web page that needs nothing beside itself: no script and no address; its pictures are part of it. */

/** A picture as a `data:` address, and what it shows. */
export interface ReportPicture {
  readonly data: string;
  readonly words: string;
}

/** What is known of a place. */
export interface ReportRow {
  readonly place: string;
  /** `#rrggbb`, as it is drawn; null where it is not. */
  readonly color: string | null;
  readonly at: string;
  readonly diameter: string;
  readonly shortest: string;
  readonly longest: string;
  readonly area: string;
  readonly flags: string;
}

export interface ReportContent {
  readonly vessel: string;
  readonly length: string;
  /** When it was saved. */
  readonly saved: string;
  /** Why a place that was marked has no percentage; null where it has one, or where none was marked. */
  readonly ungraded: string | null;
  /** The name of the scan, where the user wants it there. */
  readonly scan: string | null;
  /** Stenosis, group, stretches, distances: a paragraph each, the first ones in bold letters. */
  readonly findings: readonly string[];
  readonly remarks: readonly string[];
  readonly view: ReportPicture;
  /** The lying vessel with its profile, as the markup of an SVG. */
  readonly plot: string;
  /** What a reader marked. */
  readonly rows: readonly ReportRow[];
  readonly sections: readonly ReportPicture[];
  /** What nobody confirmed. */
  readonly suggestions: readonly ReportRow[];
  readonly suggestedSections: readonly ReportPicture[];
  /** Settings and software in words. */
  readonly told: string;
  /** How lengths are called: mm, or nothing where the file states no spacing. */
  readonly unit: string;
}

/** What every report says of itself. */
export const NOTICE = 'Lumencut is not a medical device.';

const STYLE = `
body { font: 12px/1.4 system-ui, sans-serif; color: #111; background: #fff; max-width: 186mm; margin: 4mm auto; }
h1 { font-size: 18px; margin: 0; } h2 { font-size: 13px; margin: 3mm 0 1mm; } p { margin: 1mm 0; }
.notice { font-weight: bold; } .finding { font-size: 14px; font-weight: bold; }
.top { display: grid; grid-template-columns: 55% 1fr; gap: 5mm; align-items: start; }
.top img { max-width: 100%; max-height: 86mm; display: block; }
table { border-collapse: collapse; width: 100%; } th, td { padding: .5mm 2mm .5mm 0; text-align: right; }
th { border-bottom: 1px solid #999; font-weight: normal; color: #444; vertical-align: bottom; }
th:first-child, td:first-child, .words { text-align: left; }
figure.plot { margin-top: 2mm; } .plot svg { width: 100%; height: auto; display: block; }
figure { margin: 0; break-inside: avoid; } figcaption { font-size: 11px; color: #333; }
.sections { display: grid; grid-template-columns: repeat(3, 1fr); gap: 3mm; } .sections img { width: 100%; }
.small { font-size: 10.5px; color: #333; }
@page { size: A4; margin: 10mm 12mm; }
@media print { body { margin: 0; font-size: 10.5px; } .top img { max-height: 48mm; } .plot svg { max-height: 62mm; } }
`;

const EXPLAINED =
  'Diameters are those of the lumen: thrombus and plaque are not lumen, so that an aneurysm may be wider. Diameter means that ' +
  'of a circle of the same area; ± is one standard deviation from noise and fit. A stenosis is compared with the median ' +
  'within 1.5 mm of each reference. Suggested places are no findings: a reader must look at them. The contour of a section ' +
  'is cyan where it counts for what is narrowest or widest, and orange where its flags leave it out.';

/** The report as HTML. */
export function reportPage(content: ReportContent): string {
  const { vessel, length, saved, scan, ungraded, findings, remarks, view, plot, told } = content;
  const paragraphs = [
    ...(ungraded === null ? [] : [`<p class="finding">${escaped(ungraded)}</p>`]),
    ...findings.map((words) => `<p class="finding">${escaped(words)}</p>`),
    ...remarks.map((words) => `<p>${escaped(words)}</p>`),
  ];
  return `<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<title>Lumencut: lumen of ${escaped(vessel)}</title>
<style>${STYLE}</style>
</head>
<body>
<h1>Lumen of ${escaped(vessel)}, ${escaped(length)}</h1>
${scan === null ? '' : `<p>Scan: ${escaped(scan)}</p>`}
<p>Saved on ${escaped(saved)}</p>
<p class="notice">${NOTICE}</p>
<div class="top">
${figure(view)}
<div>
${paragraphs.join('\n')}
</div>
</div>
<figure class="plot">
${plot}
<figcaption>Straightened CPR and diameter along the vessel, on one axis</figcaption>
</figure>
${placesOf(content)}
<p class="small">${EXPLAINED}</p>
<p class="small">${escaped(told)}</p>
</body>
</html>
`;
}

/** What was marked, and apart from it what nobody confirmed. */
function placesOf({ rows, sections, suggestions, suggestedSections, unit }: ReportContent): string {
  if (rows.length + suggestions.length === 0) {
    return '<h2>Places</h2>\n<p>No place is marked, and no section counts: see the flags.</p>';
  }
  const marked = rows.length > 0 ? table(rows, unit) : '<p>No place is marked.</p>';
  const offered =
    suggestions.length > 0
      ? `<h2>Suggestions, not looked at</h2>\n${table(suggestions, unit)}\n${figures(suggestedSections)}`
      : '';
  return `<h2>Places</h2>\n${marked}\n${figures(sections)}\n${offered}`;
}

function figures(sections: readonly ReportPicture[]): string {
  return sections.length > 0
    ? `<h2>Sections at these places, with the contour and without</h2>\n<div class="sections">\n${sections.map(figure).join('\n')}\n</div>`
    : '';
}

function table(rows: readonly ReportRow[], unit: string): string {
  const named = (name: string, of = unit) => (of ? `${name} (${of})` : name);
  const heads = [
    named('at'),
    named('diameter ± 1 SD'),
    named('shortest'),
    named('longest'),
    named('area', unit && `${unit}²`),
  ];
  const lines = rows.map(({ place, color, at, diameter, shortest, longest, area, flags }) => {
    const cells = [at, diameter, shortest, longest, area].map((text) => `<td>${escaped(text)}</td>`);
    const dot = color ? `<span style="color: ${color}">●</span> ` : '';
    return `<tr><td>${dot}${escaped(place)}</td>${cells.join('')}<td class="words">${escaped(flags)}</td></tr>`;
  });
  const names = heads.map((name) => `<th>${name}</th>`).join('');
  return `<table><tr><th>place</th>${names}<th class="words">flags</th></tr>\n${lines.join('\n')}</table>`;
}

function figure({ data, words }: ReportPicture): string {
  const text = escaped(words);
  return `<figure><img src="${data}" alt="${text}"><figcaption>${text}</figcaption></figure>`;
}

const ENTITIES: Readonly<Record<string, string>> = {
  '&': '&amp;',
  '<': '&lt;',
  '>': '&gt;',
  '"': '&quot;',
  "'": '&#39;',
};

/** A text that stands in HTML as it is. */
export const escaped = (text: string): string => text.replace(/[&<>"']/g, (letter) => ENTITIES[letter] ?? '');
