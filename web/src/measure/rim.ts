/** The rim around the vessels, coloured by values along them. */
import type { Legend, View } from '../core/messages';
import { camera, method, viewSettings } from '../state/store';
import { engine } from '../worker/engine';
import { measuredVessels } from './measured-vessels';

/** The view with the measured vessels that its rim needs. */
export const withRim = (view: View): View =>
  view.settings.rim ? { ...view, vessels: measuredVessels() } : view;

/** What the colours of the present rim mean, null without a rim; fails with the reason if no vessel has a value. */
export async function rimLegend(): Promise<Legend | null> {
  const [seen, settings] = [camera.peek(), viewSettings.value];
  if (!seen || !settings.rim || method.value === 'mpcpr' || method.value === 'cr') {
    return null;
  }
  const view = withRim({ camera: seen, method: method.value, settings });
  return engine.ask('rim_legend', { view });
}
