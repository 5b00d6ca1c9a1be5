import { DEVIATIONS } from '../core/generated/tables';
import type { Axis, ChartLayout } from '../core/messages';
import type { Kind } from './marks';

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
  readonly x: Axis;
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

function Grid({ x, layout: { y, bottom, ticks }, hasUnits }: ProfileChartProps) {
  const unit = hasUnits ? ' (mm)' : '';
  const middle = (y.start + y.end) / 2;
  return (
    <g>
      {ticks[0].map(({ at, words }) => (
        <g key={`x${words}`}>
          <path d={`M${at} ${y.end}V${bottom + 4}`} stroke={COLORS.grid} />
          <text x={at} y={bottom + 15} text-anchor="middle" fill={COLORS.quiet}>
            {words}
          </text>
        </g>
      ))}
      {ticks[1].map(({ at, words }) => (
        <g key={`y${words}`}>
          <path d={`M${x.start - 4} ${at}H${x.end}`} stroke={COLORS.grid} />
          <text x={x.start - 7} y={at + 4} text-anchor="end" fill={COLORS.quiet}>
            {words}
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

function Curves({ x, layout, hasUnits }: ProfileChartProps) {
  const { limit } = layout;
  return (
    <g>
      <path d={layout.range} fill={COLORS.line} fill-opacity="0.16" class="range" />
      <path d={layout.spread} fill={COLORS.line} fill-opacity="0.4" class="band" />
      <path d={layout.width} fill="none" stroke={COLORS.line} stroke-width="1.6" class="width" />
      {layout.isolated.map(([column, row]) => (
        <circle key={column} cx={column} cy={row} r="1.8" fill={COLORS.line} />
      ))}
      {layout.left_out.map(([column, row]) => (
        <circle
          key={column}
          class="left-out"
          cx={column}
          cy={row}
          r="1.8"
          fill="none"
          stroke={COLORS.leftOut}
        />
      ))}
      {limit && (
        <g class="limit">
          <path d={`M${x.start} ${limit.at}H${x.end}`} stroke={COLORS.leftOut} stroke-dasharray="1.5 3" />
          <text x={x.end - 4} y={limit.at - 3} text-anchor="end" fill={COLORS.quiet}>
            {`${limit.words}${hasUnits ? ' mm' : ''}`}
          </text>
        </g>
      )}
    </g>
  );
}

/** One row per flag that occurs, below the line of diameter 0. */
function Flags({ x, layout: { flags, y, row, word_row: wordRow, bottom } }: ProfileChartProps) {
  return (
    <g>
      {flags.map(({ look, bars }, n) => {
        const top = y.start + n * row;
        const [middle, word] = [top + 0.5 * row, bottom - (flags.length - n - 0.5) * wordRow];
        const color = look.screen;
        return (
          <g key={look.word} class="flag">
            {bars.map(([start, end]) => (
              <rect
                key={start}
                x={start}
                y={top + 0.2 * row}
                width={Math.max(end - start, 1)}
                height={0.6 * row}
                fill={color}
              />
            ))}
            <title>{`${look.word}: ${look.meaning}`}</title>
            <path d={`M${x.end + 1} ${middle}L${x.end + 7} ${word}`} stroke={color} fill="none" />
            <text x={x.end + 9} y={word + 4} fill={color} font-size="11">
              {look.word}
            </text>
          </g>
        );
      })}
    </g>
  );
}

function Legend({ x }: ProfileChartProps) {
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
