/** What two pages with one scan each send each other, so that their views stay linked. */
import type {
  Camera,
  LineId,
  Method,
  SavedScan,
  ScanIdentity,
  Settings,
  Slices,
  Vector,
  VolumeReport,
  Window,
} from './messages';

export const LINKS = ['cameras', 'cross-hairs', 'slices', 'windows', 'looks', 'layouts'] as const;
export type Link = (typeof LINKS)[number];

export const gridOf = ({ size, world_from_index }: VolumeReport): SavedScan => ({ size, world_from_index });

/** A position of the cross-hair; on a vessel also its line and the arc length (mm). */
export interface LinkedPlace {
  readonly point: Vector;
  readonly line: LineId | null;
  readonly at: number | null;
}

export interface LinkedLook {
  readonly method: Method;
  readonly settings: Settings;
  readonly isInverted: boolean;
}

/** What a page shows; one part for each link. */
export interface Seen {
  readonly cameras?: Camera;
  readonly 'cross-hairs'?: LinkedPlace;
  readonly slices?: Slices;
  readonly windows?: Window;
  readonly layouts?: string;
  readonly looks?: LinkedLook;
}

export interface OtherScan {
  /** Counts the scans that were opened in that page. */
  readonly count: number;
  readonly name: string;
  readonly grid: SavedScan;
  readonly values: string;
  readonly corners: readonly Vector[];
  readonly lines: readonly LineId[];
  readonly isHounsfield: boolean;
  /** Size of the turning view (CSS pixels). */
  readonly size: string;
}

export interface MeasuredScan {
  readonly line: LineId;
  readonly vessel: string;
  /** The profile, as the engine's `profile_record` answers it. */
  readonly record: string;
  readonly scan: string;
  readonly identity: ScanIdentity;
}
