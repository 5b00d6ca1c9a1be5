/** The question that waits for an answer. Only one is shown at a time. */
import { chosenFile, shownQuestion } from '../state/questions';
import { FileOfStudy, PacsQuestion } from './PacsQuestion';
import { FileQuestion, KeptQuestion, LeaveQuestion } from './Questions';

export function ShownQuestion() {
  const chosen = chosenFile.value;
  switch (shownQuestion.value) {
    case 'leave':
      return <LeaveQuestion />;
    case 'file':
      return <FileQuestion />;
    case 'study':
      return chosen && <FileOfStudy chosen={chosen} />;
    case 'pacs':
      return <PacsQuestion />;
    case 'kept':
      return <KeptQuestion />;
    default:
      return null;
  }
}
