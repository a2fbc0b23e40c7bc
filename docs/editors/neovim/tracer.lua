-- Scenes of tracer in Neovim 0.7 and later: as ~/.config/nvim/plugin/tracer.lua it is all that is needed.
-- vim.g.tracer_path names the program where it is not in PATH.

-- 0.7 does not heed vim.filetype.add by itself.
vim.api.nvim_create_autocmd({ "BufRead", "BufNewFile" }, { pattern = "*.ron", command = "setfiletype ron" })

local function start(found)
  local name = vim.api.nvim_buf_get_name(found.buf)
  local settings = {
    name = "tracer",
    cmd = { vim.g.tracer_path or "tracer", "lsp" },
    root_dir = vim.fn.fnamemodify(name, ":p:h"),
  }
  if name == "" or vim.fn.executable(settings.cmd[1]) == 0 then
    return
  end
  if vim.lsp.start then
    vim.lsp.start(settings, { bufnr = found.buf })
    return
  end
  -- Neovim 0.7: one server for all scenes.
  if not (vim.g.tracer_client and vim.lsp.get_client_by_id(vim.g.tracer_client)) then
    vim.g.tracer_client = vim.lsp.start_client(settings)
  end
  vim.lsp.buf_attach_client(found.buf, vim.g.tracer_client)
end

-- The server says which files of TOML and JSON are scenes.
vim.api.nvim_create_autocmd("FileType", { pattern = { "ron", "toml", "json" }, callback = start })
