/** Runs one task at a time; of the tasks that arrive meanwhile, only the latest runs. */
export class Latest {
  private isBusy = false;
  private waiting: (() => Promise<void>) | null = null;

  run(work: () => Promise<void>): void {
    if (this.isBusy) {
      this.waiting = work;
      return;
    }
    this.isBusy = true;
    void work().finally(() => {
      this.isBusy = false;
      const next = this.waiting;
      this.waiting = null;
      if (next) {
        this.run(next);
      }
    });
  }
}
