/** The lying vessel with its profile for the report: one SVG, so that both share their axis wherever it is drawn. */
import { render } from 'preact';
import type { Profile } from '../core/measuring';
import type { Pair } from '../core/messages';
import { chartLayout } from '../measure/chart-layout';
import { type Lying, lyingBox } from '../measure/lying';
import type { Place } from '../measure/marks';
import { COLORS } from '../measure/PlaceHandles';
import { PAPER, ProfileChart } from '../measure/ProfileChart';
import { pixelAt } from '../measure/scale';
import { sectionNumbers } from '../measure/sections';

/** The colours are those of the screen, which need an outline on paper. */
const OUTLINE = '#222222';

export interface PlotContent {
  readonly profile: Profile;
  readonly places: readonly Place[];
  readonly lying: Lying;
  /** The picture of the lying vessel as a `data:` address, and its pixels. */
  readonly picture: string;
  readonly pixels: Pair;
  /** Of the chart below it. */
  readonly size: Pair;
  readonly hasUnits: boolean;
}

/** The plot as the markup of an SVG. */
export function plotMarkup(content: PlotContent): string {
  const holder = document.createElement('div');
  render(<ReportPlot {...content} />, holder);
  const markup = holder.innerHTML;
  render(null, holder);
  return markup;
}

function ReportPlot({ profile, places, lying, picture, pixels, size, hasUnits }: PlotContent) {
  const layout = chartLayout(profile, size);
  const { x, y, bottom } = layout;
  const top = Math.round(lying.height);
  const box = lyingBox(x, lying, pixels);
  const marked = places.filter(({ kind }) => kind === 'place' || kind === 'reference');
  return (
    <svg viewBox={`0 0 ${size[0]} ${top + size[1]}`} role="img" aria-label="vessel and its diameter">
      <image
        href={picture}
        x={box.left}
        y={box.top}
        width={box.width}
        height={box.height}
        preserveAspectRatio="none"
      />
      {Math.abs(lying.stretch - 1) > 0.01 && (
        <text x={x.end + 6} y={top / 2} font-size="11" font-family="system-ui, sans-serif">
          {`height × ${lying.stretch.toPrecision(2)}`}
        </text>
      )}
      <g transform={`translate(0 ${top})`}>
        <ProfileChart profile={profile} layout={layout} palette={PAPER} hasUnits={hasUnits} />
      </g>
      {marked.map((place) => {
        const { diameter } = sectionNumbers(profile, place.at);
        const [column, row] = [pixelAt(x, place.at), top + pixelAt(y, Math.min(diameter ?? 0, y.high))];
        return (
          <g
            key={`${place.kind} ${place.slot}`}
            stroke={OUTLINE}
            fill={place.isSuggestion ? '#ffffff' : COLORS[place.kind]}
          >
            <path
              d={`M${column} 0V${top + bottom}`}
              stroke={COLORS[place.kind]}
              stroke-width="1.4"
              stroke-dasharray={place.isSuggestion ? '4 3' : undefined}
            />
            <path d={place.kind === 'place' ? triangle(column, row) : diamond(column, row)} />
          </g>
        );
      })}
    </svg>
  );
}

const triangle = (x: number, y: number): string => `M${x - 5} ${y - 5}H${x + 5}L${x} ${y + 4}Z`;
const diamond = (x: number, y: number): string => `M${x} ${y - 6}L${x + 5} ${y}L${x} ${y + 6}L${x - 5} ${y}Z`;
