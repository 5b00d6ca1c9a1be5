// What the page asks the kernel for: one request is under way at a time, and the latest wins.

/** When a picture at rest is asked for (ms), when it is said that the kernel does not answer, and when what to do. */
const REST_AFTER = 120;
const WAITING_AFTER = 1500;
const LOST_AFTER = 10000;

/** Asks the kernel for steps: one request is under way at a time, and later steps add up to the next one. */
class Asker {
  constructor(model, tell) {
    this.model = model;
    this.tell = tell;
    this.name = Math.random().toString(36).slice(2);
    this.count = 0;
    this.steps = [];
    this.underWay = null;
    this.isResting = true;
    this.timers = [];
  }

  ask(step) {
    const last = this.steps.at(-1);
    if (last && last[0] === step[0] && ['rotate', 'spin', 'pan', 'window'].includes(step[0])) {
      last[1] += step[1];
      last[2] += step[2];
    } else if (last && last[0] === 'scroll' && step[0] === 'scroll' && last[1] === step[1]) {
      last[2] += step[2];
    } else {
      this.steps.push(step);
    }
    this.send(true);
  }

  send(isMoving) {
    if (this.underWay) {
      return;
    }
    this.clear();
    this.count += 1;
    this.underWay = { id: `${this.name}-${this.count}`, since: performance.now(), isMoving };
    const content = { kind: 'steps', id: this.underWay.id, steps: this.steps, moving: isMoving };
    this.steps = [];
    this.wait(WAITING_AFTER, () =>
      this.tell('The kernel is busy. The view goes on as soon as it answers.', false),
    );
    this.wait(LOST_AFTER, () => {
      // The answer may be lost with the connection: the next step asks anew.
      this.underWay = null;
      this.tell(
        `No answer from the kernel for ${LOST_AFTER / 1000} s. It computes something else, or it was restarted or stopped: ` +
          'then run the cell again to have a view that turns.',
        true,
      );
    });
    this.model.send(content);
  }

  /** Whether an answer is the one that is waited for; the next request follows. */
  answered(id) {
    if (this.underWay?.id !== id) {
      return null;
    }
    const { since, isMoving } = this.underWay;
    this.underWay = null;
    this.isResting = !isMoving && this.steps.length === 0;
    this.clear();
    if (this.steps.length > 0) {
      this.send(true);
    } else if (isMoving) {
      this.wait(REST_AFTER, () => this.send(false));
    }
    return performance.now() - since;
  }

  wait(milliseconds, act) {
    this.timers.push(setTimeout(act, milliseconds));
  }

  clear() {
    this.timers.forEach(clearTimeout);
    this.timers = [];
  }
}
