;; SPDX-License-Identifier: GPL-3.0-or-later
;; Opens files in Emacs as a person would, and prints what its mode for XML makes of them: for each file a line
;; "errors FILE NUMBER SCHEMA", and where the name begins with "complete_" also "words FILE WORD...", which Emacs offers at its end.
(setq vc-handled-backends nil)
(dolist (file command-line-args-left)
  (with-current-buffer (find-file-noselect file)
    (unless (derived-mode-p 'nxml-mode) (error "%s is opened in %s" file major-mode))
    (while (rng-do-some-validation))
    (princ (format "errors %s %d %s\n" file rng-error-count rng-current-schema-file-name))
    (when (string-prefix-p "complete_" (file-name-nondirectory file))
      (goto-char (point-max))
      (let ((found (rng-completion-at-point)))
        (princ (format "words %s %s\n" file
                       (mapconcat #'identity (and found (all-completions "" (nth 2 found))) " ")))))
    (kill-buffer)))
