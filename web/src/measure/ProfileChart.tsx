/** Chart of the lumen diameter against arc length. */
import type { Profile } from '../core/messages';
import type { ChartLayout } from './chart-layout';
import { bandPath, counted, DEVIATIONS, isolated, linePath, spreadOf } from './curves';
import { flagsIn, runs } from './flags';
import type { Kind } from './marks';
import { pixelAt, ticks } from './scale';

const COLORS = {
  line: '#7db0ff',
  leftOut: '#9aa3ad',
  text: '#e6e9ed',
  quiet: '#aab3be',
  grid: '#ffffff1c',
} as const;

export interface ChartMark {
  readonly kind: Kind;
  readonly at: number;
  readonly color: string;
  readonly isSuggestion: boolean;
}

interface ProfileChartProps {
  readonly profile: Profile;
  readonly layout: ChartLayout;
  /** Whether lengths are in mm. */
  readonly hasUnits: boolean;
}

export function ProfileChart(props: ProfileChartProps) {
  const { layout } = props;
  const [width, height] = layout.size;
  return (
    <svg
      class="profile-chart"
      width={width}
      height={height}
      viewBox={`0 0 ${width} ${height}`}
      font-size="11"
      font-family="system-ui, sans-serif"
      fill={COLORS.text}
      role="img"
      aria-label="diameter of the lumen along the vessel"
    >
      <Grid {...props} />
      <Curves {...props} />
      <Flags {...props} />
      <Legend {...props} />
    </svg>
  );
}

function Grid({ layout, hasUnits }: ProfileChartProps) {
  const { x, y, bottom } = layout;
  const unit = hasUnits ? ' (mm)' : '';
  const middle = (y.start + y.end) / 2;
  return (
    <g>
      {ticks(x.low, x.high, (x.end - x.start) / 60).map((value) => (
        <g key={`x${value}`}>
          <path d={`M${pixelAt(x, value)} ${y.end}V${bottom + 4}`} stroke={COLORS.grid} />
          <text x={pixelAt(x, value)} y={bottom + 15} text-anchor="middle" fill={COLORS.quiet}>
            {value}
          </text>
        </g>
      ))}
      {ticks(y.low, y.high, (y.start - y.end) / 18).map((value) => (
        <g key={`y${value}`}>
          <path d={`M${x.start - 4} ${pixelAt(y, value)}H${x.end}`} stroke={COLORS.grid} />
          <text x={x.start - 7} y={pixelAt(y, value) + 4} text-anchor="end" fill={COLORS.quiet}>
            {value}
          </text>
        </g>
      ))}
      <path d={`M${x.start} ${y.end}V${y.start}H${x.end}`} fill="none" stroke={COLORS.quiet} />
      <text x={(x.start + x.end) / 2} y={bottom + 29} text-anchor="middle">
        {`arc length${unit}`}
      </text>
      <text transform={`translate(12 ${middle}) rotate(-90)`} text-anchor="middle">
        {y.start - y.end < 110 ? `diameter${unit}` : `lumen diameter${unit}`}
      </text>
    </g>
  );
}

function Curves({ profile, layout, hasUnits }: ProfileChartProps) {
  const { x, y } = layout;
  const at = profile.arc_length;
  const width = counted(profile, profile.diameter);
  const range = [counted(profile, profile.diameter_min), counted(profile, profile.diameter_max)] as const;
  const limit = 1.5 * profile.fwhm;
  return (
    <g>
      <path d={bandPath(x, y, at, range)} fill={COLORS.line} fill-opacity="0.16" class="range" />
      <path d={bandPath(x, y, at, spreadOf(profile))} fill={COLORS.line} fill-opacity="0.4" class="band" />
      <path d={linePath(x, y, at, width)} fill="none" stroke={COLORS.line} stroke-width="1.6" class="width" />
      {isolated(width).map((n) => (
        <circle
          key={n}
          cx={pixelAt(x, at[n] ?? 0)}
          cy={pixelAt(y, width[n] ?? 0)}
          r="1.8"
          fill={COLORS.line}
        />
      ))}
      {profile.diameter.map((value, n) =>
        value === null || profile.counts[n] || value > y.high ? null : (
          <circle
            key={at[n]}
            class="left-out"
            cx={pixelAt(x, at[n] ?? 0)}
            cy={pixelAt(y, value)}
            r="1.8"
            fill="none"
            stroke={COLORS.leftOut}
          />
        ),
      )}
      {limit < y.high && (
        <g class="limit">
          <path
            d={`M${x.start} ${pixelAt(y, limit)}H${x.end}`}
            stroke={COLORS.leftOut}
            stroke-dasharray="1.5 3"
          />
          <text x={x.end - 4} y={pixelAt(y, limit) - 3} text-anchor="end" fill={COLORS.quiet}>
            {`1.5 × FWHM: ${limit.toFixed(2)}${hasUnits ? ' mm' : ''}`}
          </text>
        </g>
      )}
    </g>
  );
}

/** Bars that mark flagged sections: one row per flag that occurs, below diameter 0. */
function Flags({ profile, layout }: ProfileChartProps) {
  const { x, y, row, wordRow, bottom } = layout;
  const flags = flagsIn(profile);
  return (
    <g>
      {flags.map((flag, n) => {
        const top = y.start + n * row;
        const [middle, word] = [top + 0.5 * row, bottom - (flags.length - n - 0.5) * wordRow];
        const color = flag.screen;
        return (
          <g key={flag.word} class="flag">
            {runs(profile, flag.word).map(([from, to]) => {
              const [start, end] = [from, to].map((place) =>
                Math.min(Math.max(pixelAt(x, place), x.start), x.end),
              ) as [number, number];
              return (
                <rect
                  key={from}
                  x={start}
                  y={top + 0.2 * row}
                  width={Math.max(end - start, 1)}
                  height={0.6 * row}
                  fill={color}
                />
              );
            })}
            <title>{`${flag.word}: ${flag.meaning}`}</title>
            <path d={`M${x.end + 1} ${middle}L${x.end + 7} ${word}`} stroke={color} fill="none" />
            <text x={x.end + 9} y={word + 4} fill={color} font-size="11">
              {flag.word}
            </text>
          </g>
        );
      })}
    </g>
  );
}

function Legend({ layout }: ProfileChartProps) {
  const { x } = layout;
  const isNarrow = x.end - x.start < 640;
  return (
    <g class="legend" fill={COLORS.quiet} transform={`translate(${x.start} 12)`}>
      <path d="M0 -3H18" stroke={COLORS.line} stroke-width="1.6" />
      <text x="23">{isNarrow ? 'diameter' : 'diameter of a circle of the same area'}</text>
      <g transform={`translate(${isNarrow ? 84 : 238} 0)`}>
        <rect y="-8" width="18" height="9" fill={COLORS.line} fill-opacity="0.4" />
        <text x="23">{isNarrow ? `± ${DEVIATIONS} SD` : `± ${DEVIATIONS} standard deviations`}</text>
      </g>
      <g transform={`translate(${isNarrow ? 160 : 404} 0)`}>
        <rect y="-8" width="18" height="9" fill={COLORS.line} fill-opacity="0.16" />
        <text x="23">shortest to longest</text>
      </g>
      <g transform={`translate(${isNarrow ? 296 : 540} 0)`}>
        <circle cx="9" cy="-4" r="2.5" fill="none" stroke={COLORS.leftOut} />
        <text x="16">left out</text>
      </g>
    </g>
  );
}
