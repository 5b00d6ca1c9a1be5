/** Anatomical names offered when the user names a vessel. */
import { VESSEL_NAMES } from '../core/generated/tables';

export function namesToOffer(taken: readonly string[]): string[] {
  const used = new Set(taken.map((name) => name.trim().toLowerCase()));
  return VESSEL_NAMES.filter((name) => !used.has(name.toLowerCase())).sort((a, b) =>
    a.localeCompare(b, 'en'),
  );
}
