# SPDX-License-Identifier: GPL-3.0-or-later
"""What the operators that change meshes have in common: when they can run, object after object, what the user hears."""

from . import outcome, progress, targets
from .library import LibraryError
from .refusal import NothingSelected, Refusal


class MeshOperator:
    """A subclass has treat(obj, tell), which returns an Outcome."""

    @classmethod
    def poll(cls, context):
        if context.mode not in {"OBJECT", "EDIT_MESH"}:
            cls.poll_message_set("Works in Object Mode and in Edit Mode")
            return False
        if not targets.objects(context):
            cls.poll_message_set("Select a mesh")
            return False
        return True

    def execute(self, context):
        objects = targets.objects(context)
        outcomes, refusals = [], []
        with progress.shown(context, len(objects)) as teller:
            for number, obj in enumerate(objects):
                try:
                    outcomes.append(self._treat_one(obj, teller(number)))
                except (Refusal, LibraryError) as refusal:
                    refusals.append(refusal)
        return self._tell(outcomes, refusals)

    def _treat_one(self, obj, tell):
        if targets.linked(obj):
            raise Refusal(targets.linked(obj))
        try:
            return self.treat(obj, tell)
        except LibraryError as error:
            # Without a status it is not this object's fault.
            raise error if error.status is None else Refusal(f"'{obj.name}': {error}")

    def _tell(self, outcomes, refusals):
        for text in dict.fromkeys(note for done in outcomes for note in done.notes):
            self.report({"WARNING"}, text)
        if outcomes:
            # In several objects the selection is often in some of them alone; that is as the user meant it.
            refusals = [refusal for refusal in refusals if not isinstance(refusal, NothingSelected)]
        for refusal in {str(refusal): refusal for refusal in refusals}.values():
            severity = "WARNING" if outcomes else getattr(refusal, "severity", "ERROR")
            self.report({severity}, str(refusal))
        if not outcomes:
            return {"CANCELLED"}
        self.report({"INFO"}, outcome.text(outcomes))
        return {"FINISHED"}
