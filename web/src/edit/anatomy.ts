/** Anatomical names offered when the user names a vessel. */

const SIDED = [
  'common carotid artery',
  'internal carotid artery',
  'external carotid artery',
  'vertebral artery',
  'anterior cerebral artery',
  'middle cerebral artery',
  'posterior cerebral artery',
  'subclavian artery',
  'axillary artery',
  'renal artery',
  'common iliac artery',
  'internal iliac artery',
  'external iliac artery',
  'common femoral artery',
  'superficial femoral artery',
  'deep femoral artery',
  'popliteal artery',
  'anterior tibial artery',
  'posterior tibial artery',
  'fibular artery',
  'pulmonary artery',
];

const SINGLE = [
  'Aorta',
  'Ascending aorta',
  'Aortic arch',
  'Descending thoracic aorta',
  'Abdominal aorta',
  'Brachiocephalic trunk',
  'Basilar artery',
  'Celiac trunk',
  'Common hepatic artery',
  'Splenic artery',
  'Left gastric artery',
  'Superior mesenteric artery',
  'Inferior mesenteric artery',
  'Ileocolic artery',
  'Left main coronary artery',
  'Left anterior descending artery',
  'Circumflex artery',
  'Right coronary artery',
  'Pulmonary trunk',
  'Portal vein',
  'Superior vena cava',
  'Inferior vena cava',
];

const ANATOMY: readonly string[] = [...SINGLE, ...SIDED.flatMap((name) => [`Left ${name}`, `Right ${name}`])];

export function namesToOffer(taken: readonly string[]): string[] {
  const used = new Set(taken.map((name) => name.trim().toLowerCase()));
  return ANATOMY.filter((name) => !used.has(name.toLowerCase())).sort((a, b) => a.localeCompare(b, 'en'));
}
