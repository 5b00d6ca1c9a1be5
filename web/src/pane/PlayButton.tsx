/** Button that plays or pauses a cine. */
import { type Cine, cine, toggleCine } from '../state/cine';

const WORDS: Readonly<Record<Cine, string>> = {
  roll: 'the rotation about the vessel, 30° per second',
  sections: 'the sections along the vessel, 10 mm per second',
};

export function PlayButton({ kind, disabled = false }: { readonly kind: Cine; readonly disabled?: boolean }) {
  const isPlaying = cine.value === kind;
  return (
    <button
      type="button"
      class="small play"
      aria-label={`Play ${kind}`}
      aria-pressed={isPlaying}
      title={`${isPlaying ? 'Pauses' : 'Plays'} ${WORDS[kind]}`}
      disabled={disabled}
      onClick={() => toggleCine(kind)}
    >
      {isPlaying ? '❚❚' : '▶'}
    </button>
  );
}
