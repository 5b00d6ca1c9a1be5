// Gestures of the page on a picture, as steps for the kernel; `npm run notebook` writes it from web/src/notebook.
var gestures = (function(exports) {
	Object.defineProperty(exports, Symbol.toStringTag, { value: "Module" });
	// src/input/bindings.ts
	var mouse = (where, button, modifier, action, words) => ({
		where,
		gesture: "drag",
		button,
		modifier,
		action,
		words
	});
	var other = (where, gesture, modifier, action, words) => ({
		where,
		gesture,
		modifier,
		action,
		words
	});
	var key = (name, action, words) => ({
		where: "everywhere",
		gesture: "key",
		key: name,
		action,
		words
	});
	var withCtrl = (name, action, words) => ({
		...key(name, action, words),
		modifier: "Ctrl"
	});
	/** A row of the help for keys that the focused view or marker handles itself. */
	var pane = (where, name, words) => ({
		where,
		gesture: "key",
		key: name,
		action: "pane",
		words
	});
	var BINDINGS = [
		mouse("turning", "left", "", "rotate", "rotate"),
		mouse("turning", "left", "Alt", "rotate about vessel", "rotate about the axis of the picked vessel"),
		mouse("turning", "left", "Ctrl", "window", "window: drag across for width, up or down for level"),
		mouse("turning", "left", "Shift", "pan", "pan"),
		mouse("turning", "middle", "", "pan", "pan"),
		mouse("turning", "right", "", "window", "window: drag across for width, up or down for level"),
		other("turning", "wheel", "", "zoom", "zoom at the pointer"),
		other("turning", "wheel", "Ctrl", "zoom", "zoom at the pointer"),
		other("turning", "wheel", "Shift", "zoom", "zoom at the pointer"),
		other("turning", "touch drag", "", "rotate", "rotate"),
		mouse("flat", "left", "", "pan", "pan"),
		mouse("flat", "left", "Ctrl", "window", "window: drag across for width, up or down for level"),
		mouse("flat", "left", "Shift", "pan", "pan"),
		mouse("flat", "middle", "", "pan", "pan"),
		mouse("flat", "right", "", "window", "window: drag across for width, up or down for level"),
		other("flat", "wheel", "", "scroll", "scroll by one slice, or rotate the straightened vessel"),
		other("flat", "wheel", "Shift", "scroll by ten", "scroll by ten"),
		other("flat", "wheel", "Ctrl", "zoom", "zoom at the pointer"),
		other("flat", "touch drag", "", "scroll", "scroll"),
		other("tracing", "click", "", "set point", "set a point of the vessel, or a stopper"),
		other("tracing", "wheel", "Alt", "step", "step to the lumen behind the one under the pointer, or back"),
		other("tracing", "double click", "", "end vessel", "end the vessel; on a curve, add a point there"),
		{
			where: "tracing",
			gesture: "click",
			button: "right",
			action: "add point",
			words: "on a curve, add a point; on a point, remove it"
		},
		pane("tracing", "Drag a point", "move the point; arrow keys move the focused point"),
		pane("tracing", "Arrows in a slice", "move the cross-hair by a voxel, with Shift by ten"),
		pane("tracing", "Page up and down", "scroll through the slices, with Shift by ten"),
		key("Enter", "enter", "while tracing, set a point at the cross-hair; press again for the whole vessel, or to end a vessel with several points"),
		key("Delete", "remove", "while tracing, remove the last point; otherwise delete the picked vessel in the list"),
		key("Backspace", "remove point", "while tracing, remove the last point"),
		other("everywhere", "two-finger drag", "", "pan", "pan"),
		other("everywhere", "pinch", "", "zoom", "zoom"),
		other("everywhere", "click", "", "pick", "move the cross-hair to the pointer"),
		other("everywhere", "double click", "", "maximise", "show this view alone, or all views again"),
		pane("turning", "Arrow keys", "rotate; with Shift pan"),
		pane("turning", "+ and -", "zoom"),
		pane("turning", "Drag to the side", "while turning about a place: rotate the cut around it"),
		pane("flat", "Up and down", "scroll"),
		pane("flat", "Page up and down", "scroll by ten"),
		pane("flat", "Left and right", "turn the planes of the other slices by 5°, while their lines are shown"),
		pane("flat", "+ and -", "zoom"),
		pane("marks", "Arrow keys", "move the marker along the vessel, with Shift ten times as far"),
		pane("marks", "Enter", "confirm a suggested place"),
		pane("marks", "Delete", "remove the marker; a right click does so too"),
		key("Escape", "cancel", "cancel the current action; otherwise end the vessel, leave the tool, or show all views"),
		key("a", "view anterior", "view from the front (anterior)"),
		key("p", "view posterior", "view from the back (posterior)"),
		key("l", "view left", "view from the patient's left"),
		key("R", "view right", "view from the patient's right (Shift+r)"),
		key("S", "view superior", "view from above (superior, Shift+s)"),
		key("I", "view inferior", "view from below (inferior, Shift+i)"),
		key("r", "reset", "reset the views and the window"),
		key("i", "invert", "invert black and white"),
		key("1", "preset 0", "window suggested by the data"),
		key("2", "preset 1", "window for CT angiography"),
		key("3", "preset 2", "window for soft tissue"),
		key("4", "preset 3", "window for bone"),
		key("5", "preset 4", "window for lung"),
		key("6", "preset 5", "window from the smallest to the largest value"),
		key("7", "preset 6", "window for MR angiography"),
		key("8", "preset 7", "window for stents"),
		key("9", "preset 8", "window for aneurysm sac"),
		key("c", "context", "show or hide the context, the body around the cut"),
		key("s", "silhouettes", "show or hide silhouette lines"),
		key("m", "measure", "measure the picked vessel, or return to the previous layout"),
		key("e", "report", "report the findings on all vessels, or return to the previous layout"),
		key("f", "best view", "best view of the picked vessel"),
		key("o", "turn about place", "start or stop turning the view about the vessel at the section"),
		key("x", "turn planes", "show or hide the lines of the planes in the slices, to turn and move them"),
		key(" ", "turn", "start or stop a slow rotation"),
		key("t", "trace", "start or stop tracing vessels by clicks"),
		key("w", "whole vessel", "while tracing, trace the whole vessel at the clicked point"),
		key("b", "branches", "find all branches from the cross-hair"),
		key("v", "vessels", "show or hide the list of vessels"),
		key(".", "next doubt", "show the next doubtful branch"),
		key(",", "previous doubt", "show the previous doubtful branch"),
		key("y", "accept doubt", "accept the doubtful branch that is shown"),
		key("n", "leave doubt out", "leave out the doubtful branch that is shown"),
		withCtrl("z", "undo", "undo"),
		withCtrl("Z", "redo", "redo"),
		withCtrl("y", "redo", "redo"),
		withCtrl("s", "save session", "save the session"),
		withCtrl("S", "save report", "save the report"),
		key("?", "help", "show this help")
	];
	/** Action of a drag, wheel or click in a view; null if there is no binding. */
	function actionOf(where, gesture, button, modifier) {
		const fits = (row) => (row.where === where || row.where === "everywhere") && row.gesture === gesture && (row.button ?? null) === button && (row.modifier ?? "") === modifier;
		return BINDINGS.find(fits)?.action ?? null;
	}
	/** Action of a key; a capital letter without a binding acts like its small letter. */
	function actionOfKey(name, modifier = "") {
		const rowOf = (key) => BINDINGS.find((row) => row.gesture === "key" && row.key === key && (row.modifier ?? "") === modifier);
		return (rowOf(name) ?? rowOf(name.toLowerCase()))?.action ?? null;
	}
	// src/core/generated/tables.ts
	/** Constants of drags, the wheel and keys. */
	var GESTURES = {
		/** Movement above which a press becomes a drag (px). */
		drag_from: 4,
		/** Time below which two clicks are a double click (ms). */
		double_within: 350,
		/** Largest distance of the two clicks of a double click (px). */
		double_near: 6,
		/** Logarithm of the zoom per pixel of the wheel (1/px). */
		zoom_per_wheel: .0016,
		/** Most pixels of one wheel event that zoom (px). */
		most_wheel: 120,
		/** Pixels of a line of the wheel, in browsers that report lines (px). */
		wheel_line: 40,
		/** Wheel movement from which an event is a notch of a mouse; trackpads report less (px). */
		notch_from: 60,
		/** Wheel movement of a notch (px). */
		notch: 110,
		/** Lines of a notch, in browsers that report lines (1). */
		notch_lines: 3,
		/** Movement of a trackpad that scrolls one step (px). */
		scroll_step: 40,
		/** Movement of a trackpad to which the same movement of a finger is equal (1). */
		finger_gain: 4,
		/** Steps for each one, with Shift or a page key (1). */
		far_steps: 10,
		/** Drag to which an arrow key is equal (px). */
		key_step: 24,
		/** Zoom of the keys + and - (1). */
		key_zoom: 1.2,
		/** Rotation of a drag as long as the view is high (rad). */
		turn_per_height: 3.141592653589793,
		/** Smallest pixel spacing that zooming reaches (mm). */
		finest_spacing: .005,
		/** Largest pixel spacing that zooming reaches (mm). */
		coarsest_spacing: 20,
		/** Part of the window's width by which a drag changes it (1/px). */
		window_per_pixel: .004,
		/** Smallest width of a window, in values of the volume (value). */
		narrowest_window: .001
	};
	// src/input/keys.ts
	/** Keys that act as drags, zooms and scrolls. */
	var ARROWS = {
		ArrowLeft: [-1, 0],
		ArrowRight: [1, 0],
		ArrowUp: [0, -1],
		ArrowDown: [0, 1]
	};
	/** Direction of an arrow key (right, down). */
	var arrowOf = (key) => ARROWS[key] ?? null;
	/** The drag that an arrow key performs (pixels). */
	function dragOfKey(key) {
		const arrow = arrowOf(key);
		return arrow && [arrow[0] * GESTURES.key_step, arrow[1] * GESTURES.key_step];
	}
	/** Zoom factor of the keys + and -. */
	function zoomOfKey(key) {
		const { key_zoom: factor } = GESTURES;
		return {
			"+": factor,
			"-": 1 / factor
		}[key] ?? null;
	}
	/** Number of steps that an arrow or page key scrolls; a page key scrolls `page` steps. */
	function scrollOfKey(key, page = GESTURES.far_steps) {
		return {
			ArrowDown: 1,
			PageDown: page,
			ArrowUp: -1,
			PageUp: -page
		}[key] ?? null;
	}
	// src/input/pointer.ts
	/** Gestures of mouse, wheel, pen and touch. A press becomes a drag after some pixels; otherwise it is a click. */
	function listen(element, where, handlers) {
		const gestures = new Pointers$1(element, where, handlers);
		const stop = new AbortController();
		const options = { signal: stop.signal };
		element.addEventListener("pointerdown", (event) => gestures.down(event), options);
		element.addEventListener("pointermove", (event) => gestures.move(event), options);
		element.addEventListener("pointerup", (event) => gestures.up(event), options);
		element.addEventListener("pointercancel", (event) => gestures.cancel(event), options);
		element.addEventListener("pointerleave", () => handlers.leave?.(), options);
		element.addEventListener("wheel", (event) => gestures.wheel(event), {
			passive: false,
			signal: stop.signal
		});
		window.addEventListener("keydown", (event) => gestures.key(event), {
			capture: true,
			signal: stop.signal
		});
		element.addEventListener("contextmenu", (event) => event.preventDefault(), options);
		return () => stop.abort();
	}
	var BUTTONS = [
		"left",
		"middle",
		"right"
	];
	function modifierOf(event) {
		return event.altKey ? "Alt" : event.ctrlKey || event.metaKey ? "Ctrl" : event.shiftKey ? "Shift" : "";
	}
	var Pointers$1 = class {
		element;
		where;
		handlers;
		held = /* @__PURE__ */ new Map();
		start = [0, 0];
		action = null;
		clickAction = null;
		isDragging = false;
		spread = 0;
		steps = new Steps();
		lastClick = {
			time: Number.NEGATIVE_INFINITY,
			at: [0, 0]
		};
		constructor(element, where, handlers) {
			this.element = element;
			this.where = where;
			this.handlers = handlers;
		}
		placeOf(event) {
			const box = this.element.getBoundingClientRect();
			return [event.clientX - box.left, event.clientY - box.top];
		}
		down(event) {
			if (event.target?.closest?.("button, input, select")) return;
			const at = this.placeOf(event);
			this.held.set(event.pointerId, at);
			this.element.setPointerCapture(event.pointerId);
			if (event.button === 1) event.preventDefault();
			if (this.held.size > 1) {
				this.beginTwo();
				return;
			}
			this.start = at;
			this.isDragging = false;
			const isTouch = event.pointerType === "touch";
			const button = BUTTONS[event.button] ?? "left";
			this.action = isTouch ? actionOf(this.where, "touch drag", null, "") : actionOf(this.where, "drag", button, modifierOf(event));
			this.clickAction = this.clickedWith("click", button === "left" ? null : button);
		}
		clickedWith(gesture, button) {
			const rows = this.handlers.rows?.() ?? null;
			return (rows && actionOf(rows, gesture, button, "")) ?? actionOf(this.where, gesture, button, "");
		}
		beginTwo() {
			this.spread = this.distance();
			if (!this.isDragging) this.handlers.begin();
			this.isDragging = true;
			this.clickAction = null;
		}
		distance() {
			const [a, b] = [...this.held.values()];
			return a && b ? Math.hypot(a[0] - b[0], a[1] - b[1]) : 0;
		}
		move(event) {
			const at = this.placeOf(event);
			const before = this.held.get(event.pointerId);
			if (!before) {
				this.handlers.hover(at, event.shiftKey);
				return;
			}
			const by = [at[0] - before[0], at[1] - before[1]];
			if (this.held.size > 1) {
				this.held.set(event.pointerId, at);
				this.moveTwo(by);
				return;
			}
			if (!this.isDragging && Math.hypot(at[0] - this.start[0], at[1] - this.start[1]) <= GESTURES.drag_from) return;
			if (!this.isDragging) {
				this.isDragging = true;
				this.handlers.leave?.();
				this.handlers.begin();
			}
			this.held.set(event.pointerId, at);
			this.dragged(by, at);
		}
		moveTwo(by) {
			const middle = this.middle();
			const spread = this.distance();
			if (this.spread > 0 && spread > 0) this.handlers.zoom(spread / this.spread, middle);
			this.spread = spread;
			this.handlers.drag("pan", [by[0] / 2, by[1] / 2], middle);
		}
		middle() {
			const [a, b] = [...this.held.values()];
			return a && b ? [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2] : this.start;
		}
		dragged(by, at) {
			if (this.action === "scroll") this.scrollBy(this.steps.ofPixels(by[1] * GESTURES.finger_gain));
			else if (this.action) this.handlers.drag(this.action, by, at);
		}
		up(event) {
			if (!this.held.delete(event.pointerId)) return;
			if (this.isDragging) {
				if (this.held.size === 0) {
					this.isDragging = false;
					this.handlers.end();
				}
				return;
			}
			if (this.clickAction) this.click(this.placeOf(event), event);
		}
		click(at, { timeStamp: time, button }) {
			const last = this.lastClick;
			const isNear = Math.hypot(at[0] - last.at[0], at[1] - last.at[1]) <= GESTURES.double_near;
			if (time - last.time < GESTURES.double_within && isNear && button === 0) {
				this.lastClick = {
					time: Number.NEGATIVE_INFINITY,
					at
				};
				const action = this.clickedWith("double click", null);
				if (action) this.handlers.click(action, at);
				return;
			}
			this.lastClick = {
				time,
				at
			};
			if (this.clickAction) this.handlers.click(this.clickAction, at);
		}
		cancel(event) {
			this.held.delete(event.pointerId);
			if (this.isDragging && this.held.size === 0) {
				this.isDragging = false;
				this.handlers.end();
			}
		}
		key(event) {
			if (event.key === "Escape" && this.isDragging) {
				event.stopPropagation();
				event.preventDefault();
				this.held.clear();
				this.isDragging = false;
				this.handlers.putBack();
			}
		}
		wheel(event) {
			event.preventDefault();
			const rows = this.handlers.rows?.() ?? null;
			const modifier = modifierOf(event);
			const action = (rows && actionOf(rows, "wheel", null, modifier)) ?? actionOf(this.where, "wheel", null, modifier);
			if (action === "step") {
				this.handlers.step?.(this.steps.ofWheel(event));
				return;
			}
			this.handlers.leave?.();
			if (action === "zoom") this.handlers.zoom(zoomOfWheel(event), this.placeOf(event));
			else if (action === "scroll" || action === "scroll by ten") this.scrollBy(this.steps.ofWheel(event) * (action === "scroll" ? 1 : GESTURES.far_steps));
		}
		scrollBy(steps) {
			if (steps !== 0) this.handlers.scroll(steps);
		}
	};
	/** Converts wheel movements to steps: one per mouse notch; trackpad movements add up. */
	var Steps = class {
		rest = 0;
		/** The number of complete steps of a wheel event; the remainder is kept for the next event. */
		ofWheel(event) {
			const by = alongWheel(event);
			const isInPixels = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL;
			if (isInPixels && Math.abs(by) < GESTURES.notch_from) return this.ofPixels(by);
			this.rest = 0;
			const notches = Math.abs(by) / (isInPixels ? GESTURES.notch : GESTURES.notch_lines);
			return Math.sign(by) * Math.max(1, Math.round(notches));
		}
		ofPixels(pixels) {
			this.rest += pixels;
			const steps = Math.trunc(this.rest / GESTURES.scroll_step);
			this.rest -= steps * GESTURES.scroll_step;
			return steps;
		}
	};
	/** The movement of the wheel; with Shift, browsers report it as horizontal. */
	var alongWheel = ({ deltaX, deltaY, shiftKey }) => shiftKey && deltaY === 0 ? deltaX : deltaY;
	/** Zoom of a wheel event; trackpads send many small ones. */
	function zoomOfWheel(event) {
		const { wheel_line: line, most_wheel: most, zoom_per_wheel: part } = GESTURES;
		const pixels = alongWheel(event) * (event.deltaMode === WheelEvent.DOM_DELTA_LINE ? line : 1);
		return Math.exp(-Math.max(-most, Math.min(most, pixels)) * part);
	}
	// src/notebook/pointers.ts
	var DRAGS = {
		rotate: "rotate",
		"rotate about vessel": "spin",
		pan: "pan",
		window: "window"
	};
	var KEYS = {
		reset: "reset",
		silhouettes: "silhouettes",
		"remove point": "undo",
		remove: "undo",
		enter: "end"
	};
	/** Handles keys, and gestures of mouse, pen and touch, on a pane. */
	var Pointers = class {
		pane;
		asker;
		constructor(pane, asker) {
			this.pane = pane;
			this.asker = asker;
		}
		get isTurning() {
			return this.pane.name === "vessels";
		}
		listen(signal) {
			const { element } = this.pane;
			for (const name of [
				"pointerdown",
				"wheel",
				"contextmenu"
			]) element.addEventListener(name, (event) => event.stopPropagation(), { signal });
			const focus = (event) => {
				event.preventDefault();
				element.focus({ preventScroll: true });
			};
			element.addEventListener("pointerdown", focus, { signal });
			element.addEventListener("keydown", (event) => this.key(event), { signal });
			signal.addEventListener("abort", listen(element, this.isTurning ? "turning" : "flat", this.handlers()));
		}
		handlers() {
			const { pane, asker } = this;
			return {
				drag: (action, by) => this.drag(action, by),
				zoom: (factor, at) => {
					if (this.isTurning) asker.ask([
						"zoom",
						factor,
						...pane.pixelOf(at)
					]);
				},
				scroll: (steps) => asker.ask([
					"scroll",
					pane.name,
					steps
				]),
				click: (action, at) => asker.ask([
					action === "pick" ? "click" : "double click",
					pane.name,
					...pane.pixelOf(at)
				]),
				hover: () => void 0,
				begin: () => asker.ask(["begin"]),
				end: () => void 0,
				putBack: () => asker.ask(["back"])
			};
		}
		/** Other pictures than the view only change their window; the kernel neither pans nor zooms them. */
		drag(action, by) {
			const step = this.isTurning || action === "window" ? DRAGS[action] : void 0;
			if (step) this.asker.ask([
				step,
				by[0] * this.pane.scale,
				by[1] * this.pane.scale
			]);
		}
		key(event) {
			const step = this.stepOf(event);
			if (step) {
				event.preventDefault();
				event.stopPropagation();
				this.asker.ask(step);
			}
		}
		/** The step of a key; null for a key that the notebook handles. */
		stepOf(event) {
			if (event.ctrlKey || event.metaKey || event.altKey) return null;
			return (this.isTurning ? this.turningStep(event) : this.flatStep(event)) ?? commonStep(event.key);
		}
		turningStep({ key, shiftKey }) {
			const [by, factor] = [dragOfKey(key), zoomOfKey(key)];
			if (by) return [shiftKey ? "pan" : "rotate", ...by];
			return factor === null ? null : [
				"zoom",
				factor,
				...this.middle()
			];
		}
		middle() {
			const [width, height] = this.pane.size;
			return [(width - 1) / 2, (height - 1) / 2];
		}
		flatStep({ key }) {
			const steps = scrollOfKey(key);
			return steps === null ? null : [
				"scroll",
				this.pane.name,
				steps
			];
		}
	};
	function commonStep(key) {
		const action = actionOfKey(key);
		if (action?.startsWith("view ")) return ["view", action.slice(5)];
		if (action?.startsWith("preset ")) return ["preset", Number(action.slice(7))];
		const name = action && KEYS[action];
		return name ? [name] : null;
	}
	exports.Pointers = Pointers;
	return exports;
})({});
