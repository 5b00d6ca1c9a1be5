/** Everything that is drawn over a view for tracing. */
import { Places } from './Places';
import type { Projection } from './projection';
import { Stoppers } from './Stoppers';
import { VesselCurves } from './VesselCurves';
import { VesselPoints } from './VesselPoints';

export function TracedOverlay({ projection }: { readonly projection: Projection }) {
  return (
    <>
      <VesselCurves projection={projection} />
      <Stoppers projection={projection} />
      <VesselPoints projection={projection} />
      <Places projection={projection} />
    </>
  );
}
