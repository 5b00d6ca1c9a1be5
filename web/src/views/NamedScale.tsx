/** Name of the picked vessel and scale bar, over a picture of that vessel alone. */

import type { Pair } from '../core/messages';
import { currentVessel } from '../measure/current';
import { EdgeLabels } from './EdgeLabels';

interface NamedScaleProps {
  readonly size: Pair;
  /** Side of a pixel along the vessel, which runs downwards (mm). */
  readonly spacing: number | null;
  /** Whether the picture shows this vessel alone. */
  readonly isNamed?: boolean;
}

export function NamedScale({ size, spacing, isNamed = true }: NamedScaleProps) {
  return (
    <>
      {isNamed && (
        <b class="vessel-name" data-testid="vessel-name">
          {currentVessel.value?.name}
        </b>
      )}
      {spacing !== null && (
        <div class="along">
          <EdgeLabels {...NO_SIDES} size={[size[1], size[0]]} spacing={spacing} />
        </div>
      )}
    </>
  );
}

/** Straightened vessels have no sides of the body. */
const NO_SIDES = { right: [1, 0, 0], down: [0, 1, 0], hasSides: false } as const;
