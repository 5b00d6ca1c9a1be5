/** The active tool, which determines what a click does. */
import { signal } from '@preact/signals';

export type Tool = 'look' | 'trace' | 'stopper' | 'seed' | 'ruler';

export const tool = signal<Tool>('look');

/** Id of the vessel being extended; null if the next point begins one. */
export const active = signal<number | null>(null);

export const chosenDoubt = signal<number | null>(null);

/** Whether doubtful branches are listed and drawn; at first they are left out. */
export const areDoubtfulShown = signal(false);

export function showDoubtful(are: boolean): void {
  areDoubtfulShown.value = are;
}

const TRACING: readonly Tool[] = ['trace', 'stopper', 'seed'];

export const isTracing = (): boolean => TRACING.includes(tool.value);

export function takeTool(wanted: Tool): void {
  tool.value = wanted;
}

export function toggleTool(wanted: Tool): void {
  tool.value = tool.value === wanted ? 'look' : wanted;
}

/** The next points extend this vessel; without one, the next point begins a vessel. */
export function extend(id: number | null): void {
  active.value = id;
}

export function chooseDoubt(id: number | null): void {
  chosenDoubt.value = id;
}
