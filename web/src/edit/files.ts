/** The document's vessels as files of centerlines, and centerlines that come to a document. */
import type { VesselReport } from '../core/messages';
import type { CenterlineKind, Tracing } from '../core/tracing';
import { nameOf, withVessels } from './changes';
import { commitPlain } from './committing';
import { document_ } from './history';

/** All vessels that are not doubtful as a file, also those that are hidden. */
export async function centerlineFile(tracing: Tracing, kind: CenterlineKind): Promise<Blob> {
  const vessels = document_.value.vessels.filter((vessel) => vessel.doubt === null);
  const lines = vessels.map((vessel) => ({ line: vessel.line, name: nameOf(vessel) }));
  return new Blob([await tracing.write(lines, kind)], { type: 'application/octet-stream' });
}

/** Adds vessels that were read from files. */
export const addLoaded = (vessels: readonly VesselReport[]): Promise<boolean> =>
  commitPlain('open centerlines', (document) =>
    withVessels(
      document,
      vessels.map(({ line, name }) => ({ line, name })),
    ),
  );
