"""Prints a page into a PDF by Chromium, without its dates and the names of files of this machine."""

import os
import re
import subprocess
import tempfile
import time


QUIET = ("--disable-gpu", "--no-first-run", "--disable-dev-shm-usage", "--disable-background-networking",
         "--host-resolver-rules=MAP * ~NOTFOUND")


def print_pdf(chromium, page, pdf):
    with tempfile.TemporaryDirectory() as profile:
        sandbox = ["--no-sandbox"] if os.geteuid() == 0 else []  # for root, Chromium has no sandbox
        subprocess.run([chromium, "--headless", *sandbox, *QUIET, f"--user-data-dir={profile}",
                        "--no-pdf-header-footer", "--generate-pdf-document-outline", f"--print-to-pdf={pdf}",
                        page.resolve().as_uri()], check=True, capture_output=True)
    day = time.strftime("D:%Y%m%d%H%M%S", time.gmtime(int(os.environ.get("SOURCE_DATE_EPOCH", 0))))
    text = re.sub(rb"(?<=Date \()D:\d{14}", day.encode(), pdf.read_bytes())  # the same length: places stay
    pdf.write_bytes(text)
