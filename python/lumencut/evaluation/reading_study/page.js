'use strict';
const study = JSON.parse(document.getElementById('study').textContent);
const part = (name) => document.getElementById(name);
const parts = ['start', 'question', 'pause', 'end'];
const answers = [];
let reader = 0;
let questions = [];
let shownAt = 0;
let hiddenFor = 0;
let hiddenSince = null;
let isSaved = true;

function show(name) {
  for (const other of parts) {
    part(other).hidden = other !== name;
  }
}

/** Shows a question; its time begins when all its pictures are drawn. */
async function ask() {
  const question = questions[answers.length];
  part('progress').textContent = `Question ${answers.length + 1} of ${questions.length}`;
  part('words').textContent = question.words;
  const figures = question.pictures.map((name, number) => {
    const figure = document.createElement('figure');
    const image = document.createElement('img');
    const letter = question.pictures.length > 1 ? question.choices[number] : '';
    image.src = study.pictures[name];
    image.alt = letter ? `Picture ${letter}` : 'The picture';
    figure.append(image, letter);
    return figure;
  });
  part('pictures').replaceChildren(...figures);
  part('choices').replaceChildren();
  show('question');
  await Promise.all(figures.map((figure) => figure.firstChild.decode()));
  part('choices').replaceChildren(...question.choices.map(choiceButton));
  part('words').focus();
  shownAt = performance.now();
  hiddenFor = 0;
  hiddenSince = document.hidden ? shownAt : null;
}

function choiceButton(words, choice) {
  const button = document.createElement('button');
  button.type = 'button';
  button.textContent = words;
  button.onclick = () => answer(choice);
  return button;
}

function answer(choice) {
  const seconds = (performance.now() - shownAt - hiddenFor) / 1000;
  answers.push({ question: questions[answers.length].name, choice, seconds: Math.round(seconds * 1000) / 1000 });
  isSaved = false;
  part('answered').textContent = `${answers.length} of ${questions.length} questions answered.`;
  show(answers.length < questions.length ? 'pause' : 'end');
  part(answers.length < questions.length ? 'next' : 'save').focus();
}

function save() {
  const content = { format: 'lumencut-reading-answers', version: 1, study: study.study, reader, answers };
  const link = document.createElement('a');
  link.href = URL.createObjectURL(new Blob([`${JSON.stringify(content, null, 1)}\n`], { type: 'application/json' }));
  link.download = `answers-${String(reader).padStart(2, '0')}.json`;
  link.click();
  isSaved = true;
}

document.querySelector('form').onsubmit = (event) => {
  event.preventDefault();
  reader = Number(part('reader').value);
  questions = study.readers[reader];
  void ask();
};
part('next').onclick = () => void ask();
part('save').onclick = save;
document.addEventListener('visibilitychange', () => {
  if (document.hidden) {
    hiddenSince = performance.now();
  } else if (hiddenSince !== null) {
    hiddenFor += performance.now() - hiddenSince;
    hiddenSince = null;
  }
});
window.addEventListener('beforeunload', (event) => {
  if (!isSaved) {
    event.preventDefault();
  }
});
