/** Cube that shows the orientation of the patient in the view. */
import { rightOf } from '../core/camera';
import type { Camera, Vector } from '../core/messages';
import { dot } from '../core/vectors';

const SIDE = 17;
const FACES: readonly {
  readonly normal: Vector;
  readonly letter: string;
  readonly corners: readonly Vector[];
}[] = [
  { normal: [1, 0, 0], letter: 'L' },
  { normal: [-1, 0, 0], letter: 'R' },
  { normal: [0, 1, 0], letter: 'P' },
  { normal: [0, -1, 0], letter: 'A' },
  { normal: [0, 0, 1], letter: 'S' },
  { normal: [0, 0, -1], letter: 'I' },
].map(({ normal, letter }) => {
  const axis = normal.findIndex((part) => part !== 0);
  const corner = (a: number, b: number): Vector => {
    const at = [a, b];
    return [0, 1, 2].map((n) => (n === axis ? (normal[n] ?? 0) : (at.shift() ?? 0))) as unknown as Vector;
  };
  return {
    normal: normal as unknown as Vector,
    letter,
    corners: [corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)],
  };
});

export function Cube({ camera }: { readonly camera: Camera }) {
  const right = rightOf(camera);
  const seen = (point: Vector) => [SIDE * dot(point, right), -SIDE * dot(point, camera.up)] as const;
  const faces = FACES.filter((face) => dot(face.normal, camera.direction) < -0.02);
  return (
    <svg
      class="cube"
      width="64"
      height="64"
      viewBox="-32 -32 64 64"
      role="img"
      aria-label="orientation of the view"
    >
      {faces.map(({ letter, normal, corners }) => {
        const [x, y] = seen(normal);
        return (
          <g key={letter}>
            <polygon points={corners.map((corner) => seen(corner).join(',')).join(' ')} />
            <text x={x} y={y} text-anchor="middle" dominant-baseline="central">
              {letter}
            </text>
          </g>
        );
      })}
    </svg>
  );
}
